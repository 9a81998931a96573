#include "mechanics/unknowns.h"

#include <Eigen/Geometry>

namespace bight {

Unknowns::Unknowns(std::vector<int> blocks, int coordinates, const std::vector<bool>& held,
                   std::vector<Turn> turns, const std::vector<Image>& images)
    : coordinates_(coordinates), index_(held.size(), -1), turns_(std::move(turns)) {
  if (!turns_.empty()) turn_of_.assign(held.size(), -1);
  for (size_t t = 0; t < turns_.size(); ++t)
    for (int first : turns_[t].carried)
      for (int c = 0; c < 3; ++c) turn_of_[first + c] = static_cast<int>(t);

  blocks.push_back(coordinates);
  block_start_.push_back(0);
  for (size_t b = 0; b + 1 < blocks.size(); ++b) {
    const int before = size_;
    for (int i = blocks[b]; i < blocks[b + 1]; ++i) {
      if (held[i] || turn_of(i) >= 0 || (!images.empty() && images[i].source >= 0)) continue;
      index_[i] = size_++;
      block_of_.push_back(static_cast<int>(block_start_.size()) - 1);
    }
    if (size_ > before) block_start_.push_back(size_);
  }
  if (images.empty()) return;
  sign_.assign(held.size(), 1.0);
  for (int i = 0; i < coordinates; ++i)
    if (images[i].source >= 0) {
      index_[i] = index_[images[i].source];
      sign_[i] = images[i].sign;
    }
}

Vector3 Unknowns::velocity(const Turn& turn, const Vector3& position) {
  return turn.axis.cross(position - turn.point);
}

Vector3 Unknowns::acceleration(const Turn& turn, const Vector3& position) {
  return turn.axis.cross(velocity(turn, position));
}

Vector Unknowns::reduce(const Vector& x, const Vector& gradient) const {
  Vector reduced = Vector::Zero(size_);
  for (int i = 0; i < coordinates(); ++i)
    if (index_[i] >= 0) reduced[index_[i]] += sign(i) * gradient[i];
  for (const Turn& turn : turns_)
    for (int first : turn.carried)
      reduced[index_[turn.angle]] +=
          sign(turn.angle) * velocity(turn, x.segment<3>(first)).dot(gradient.segment<3>(first));
  return reduced;
}

Vector Unknowns::expand(const Vector& x, const Vector& step) const {
  Vector dx = Vector::Zero(x.size());
  for (int i = 0; i < coordinates(); ++i)
    if (index_[i] >= 0) dx[i] = sign(i) * step[index_[i]];
  for (const Turn& turn : turns_)
    for (int first : turn.carried)
      dx.segment<3>(first) = velocity(turn, x.segment<3>(first)) * dx[turn.angle];
  return dx;
}

Vector Unknowns::moved_mass(const Vector& x, Vector mass) const {
  for (const Turn& turn : turns_)
    for (int first : turn.carried) {
      mass[turn.angle] += mass[first] * velocity(turn, x.segment<3>(first)).squaredNorm();
      mass.segment<3>(first).setZero();
    }
  return mass;
}

void Unknowns::advance(Vector& x, const Vector& dx) const {
  if (turns_.empty()) {
    x += dx;
    return;
  }
  const Vector before = x;
  x += dx;
  for (const Turn& turn : turns_) {
    const Matrix3 rotation = Eigen::AngleAxisd(dx[turn.angle], turn.axis).toRotationMatrix();
    for (int first : turn.carried)
      x.segment<3>(first) = turn.point + rotation * (before.segment<3>(first) - turn.point);
  }
}

}  // namespace bight
