#include "rod1d/loose_start.h"

#include <sstream>
#include <stdexcept>

namespace bight::rod1d {

namespace {

double shortening(const Polyline& line) {
  return polyline_length(line) - (line.back() - line.front()).norm();
}

}  // namespace

Polyline loose_start(const LooseKnot& knot, double length, double ebar, int segments) {
  const auto refuse = [&](const char* why) {
    std::ostringstream text;
    text << "a rod of length " << length << " D cannot be tied into a loose " << knot.name
         << " knot at ebar " << ebar << ": " << why;
    throw std::invalid_argument(text.str());
  };
  if (!(ebar >= knot.loosest)) refuse("the loop would be too small");
  double low = knot.smallest, high = 0.5 * ebar;
  for (int i = 0; i < 60; ++i) {
    const double R = 0.5 * (low + high);
    (shortening(knot.shape(R)) < ebar ? low : high) = R;
  }
  Polyline line = knot.shape(low);
  const double tail = 0.5 * (length - polyline_length(line));
  if (!(tail >= 0)) refuse("nothing is left for the tails");
  line.front().z() -= tail;
  line.back().z() += tail;
  return resampled(line, segments);
}

}  // namespace bight::rod1d
