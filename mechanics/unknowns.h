#pragma once

#include <vector>

#include "mechanics/types.h"

namespace bight {

/// A rigid rotation, about an axis, of points whose coordinates it carries along: an end that is
/// clamped but free to turn. Its angle is a coordinate of its own.
struct Turn {
  Vector3 point = Vector3::Zero();  ///< on the axis [D]
  Vector3 axis = Vector3::UnitZ();  ///< unit vector
  int angle = -1;                   ///< coordinate that holds the angle [rad]
  std::vector<int> carried;         ///< first coordinates (x of x, y, z) of the carried points
};

/// A coordinate that is `sign` times another one: the other half of a symmetric body.
struct Image {
  int source = -1;  ///< -1: the coordinate is no image
  double sign = 1;
};

/// Which coordinates Newton moves, and how it numbers them. A coordinate is free (an unknown),
/// held (its value is given), an image of another one, or carried by a turn (it follows the turn's
/// angle).
///
/// Unknowns are numbered by blocks: the free coordinates of one node or one angle, adjacent in x.
/// The pattern of the Hessian is kept by blocks.
class Unknowns {
 public:
  /// `blocks`: first coordinate of every block, ascending, up to `coordinates`. Coordinates from
  /// there on are internal. `images`: empty, or one per coordinate; a source is no image itself.
  Unknowns(std::vector<int> blocks, int coordinates, const std::vector<bool>& held,
           std::vector<Turn> turns = {}, const std::vector<Image>& images = {});

  int size() const { return size_; }
  int blocks() const { return static_cast<int>(block_start_.size()) - 1; }
  /// Coordinates that are not internal.
  int coordinates() const { return coordinates_; }

  /// Unknown number of a coordinate, that of its source for an image; -1 when held, carried or
  /// internal.
  int index(int coordinate) const { return index_[coordinate]; }
  /// d coordinate / d unknown: -1 for some images, else 1.
  double sign(int coordinate) const { return sign_.empty() ? 1 : sign_[coordinate]; }
  bool has_images() const { return !sign_.empty(); }
  /// Which turn carries a coordinate, -1 for none.
  int turn_of(int coordinate) const { return turn_of_.empty() ? -1 : turn_of_[coordinate]; }
  const std::vector<Turn>& turns() const { return turns_; }

  int block_of(int unknown) const { return block_of_[unknown]; }
  int block_begin(int block) const { return block_start_[block]; }
  int block_size(int block) const { return block_start_[block + 1] - block_start_[block]; }

  /// Gradient by unknowns from the gradient by coordinates (chain rule for carried points).
  Vector reduce(const Vector& x, const Vector& gradient) const;

  /// Step in coordinates from a step in unknowns: linear for free ones; carried points get the
  /// tangent of their rotation. Internal entries are zero.
  Vector expand(const Vector& x, const Vector& step) const;

  /// d position / d angle of a carried point, and its second derivative.
  static Vector3 velocity(const Turn& turn, const Vector3& position);
  static Vector3 acceleration(const Turn& turn, const Vector3& position);

  /// Mass by coordinates where the unknowns move it: that of carried points becomes the moment of
  /// inertia of their angle, m |axis x (position - point)|^2, which a turn leaves as it is.
  Vector moved_mass(const Vector& x, Vector mass) const;

  /// x + dx, with carried points rotated exactly.
  void advance(Vector& x, const Vector& dx) const;

 private:
  int size_ = 0, coordinates_ = 0;
  std::vector<int> index_, turn_of_, block_start_, block_of_;
  std::vector<double> sign_;  ///< empty without images
  std::vector<Turn> turns_;
};

}  // namespace bight
