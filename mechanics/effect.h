#pragma once

#include <functional>
#include <limits>
#include <span>
#include <string_view>

#include "mechanics/types.h"

namespace bight {

/// What a caller wants of an element: energy alone, or also its derivatives.
enum class Order { energy, gradient, hessian };

constexpr double inadmissible = std::numeric_limits<double>::infinity();

/// Energy, gradient and Hessian of one stencil of N coordinates: what element functions return.
template <int N>
struct Element {
  double energy = 0;
  Eigen::Matrix<double, N, 1> gradient = Eigen::Matrix<double, N, 1>::Zero();
  Eigen::Matrix<double, N, N> hessian = Eigen::Matrix<double, N, N>::Zero();
};

/// Where an effect writes the element of one stencil: `gradient` has as many entries as the
/// stencil has coordinates, `hessian` is square, column by column. Both hold zeros on entry.
struct ElementSlot {
  double energy = 0;
  double* gradient = nullptr;
  double* hessian = nullptr;
  bool empty = false;  ///< set by an element that adds nothing: neither energy nor derivatives

  template <int N>
  void set(const Element<N>& element, Order order) {
    energy = element.energy;
    if (order >= Order::gradient) Eigen::Matrix<double, N, 1>::Map(gradient) = element.gradient;
    if (order >= Order::hessian) Eigen::Matrix<double, N, N>::Map(hessian) = element.hessian;
  }
};

/// One physical effect (stretch, bend, strain, contact, ...) as a sum of stencil energies.
///
/// The state is one vector x of coordinates: positions and angles, which Newton moves, and behind
/// them the internal coordinates that an effect condenses (pressure of a cell), which it does not.
/// An effect computes numbers for one stencil at a time, from x and its own constants; assembly,
/// solver, energy table, report and derivative tests work for whatever is in the list of effects.
class Effect {
 public:
  virtual ~Effect() = default;

  virtual std::string_view name() const = 0;

  /// Whether it acts from outside: its energy changes when all is moved or turned as a whole.
  virtual bool from_outside() const { return false; }

  /// Number of stencils that may carry energy now, and the coordinates of each.
  virtual int stencils() const = 0;
  virtual std::span<const int> coordinates(int stencil) const = 0;

  /// Energy [E D^3] and derivatives by the stencil's coordinates. An inadmissible state (inverted
  /// cell, segment of no length) has the energy `inadmissible`; its derivatives are not read.
  /// With internal coordinates the derivatives are those with the internal ones condensed.
  virtual void element(const Vector& x, int stencil, Order order, ElementSlot& slot) const = 0;

  /// Finds the stencils anew for states near x. Only effects whose stencils depend on the state
  /// (contact) have something to do.
  virtual void refresh(const Vector& x) { (void)x; }

  /// Calls `couple` with every set of coordinates that may be coupled until the next refresh():
  /// the stencils, and for contact the pairs near enough to become stencils.
  virtual void couplings(const std::function<void(std::span<const int>)>& couple) const {
    for (int i = 0; i < stencils(); ++i) couple(coordinates(i));
  }

  /// Fills the internal entries of dx from the others: the part of a Newton step that
  /// condensation has left out.
  virtual void recover(const Vector& x, Vector& dx) const { (void)x, (void)dx; }

  /// Puts the internal entries of x at their stationary value for the others.
  virtual void settle(Vector& x) const { (void)x; }

  /// Largest fraction in (0, 1] of dx that may be taken from x: no strand passes another.
  virtual double longest_step(const Vector& x, const Vector& dx) const {
    (void)x, (void)dx;
    return 1.0;
  }
};

}  // namespace bight
