#pragma once

#include <cmath>
#include <numbers>
#include <string>
#include <string_view>

namespace bight::coupling {

/// "8.3 mm" in `unit` ("m"). Throws InputError that says what cannot be read.
double parse_quantity(std::string_view text, const std::string& unit);

/// From the dimensionless world of the models (lengths in D, stresses in E, densities in rho) to
/// SI.
struct Scales {
  double diameter;        ///< D [m]
  double youngs_modulus;  ///< E [Pa]
  double density = 1;     ///< rho [kg/m^3]; for what knows time

  double length() const { return diameter; }
  double stress() const { return youngs_modulus; }
  double force() const { return youngs_modulus * diameter * diameter; }
  double energy() const { return force() * diameter; }
  double force_per_length() const { return force() / diameter; }
  double speed() const { return std::sqrt(youngs_modulus / density); }
  double time() const { return diameter / speed(); }
  double acceleration() const { return speed() / time(); }
};

/// Tbar = T D^2/(4 B), B = pi E D^4/64, of a tension in E D^2.
inline double normalised_force(double tension) { return tension * 16.0 / std::numbers::pi; }

}  // namespace bight::coupling
