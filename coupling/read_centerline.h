#pragma once

#include <filesystem>

#include "mechanics/types.h"

namespace bight::coupling {

/// Reads a centerline [m]: CSV with columns x, y, z (by name when there is a header line), or rows
/// of numbers x y z ... parted by blanks. Lines that begin with # are comments. A point that
/// repeats the one before is left out. Throws InputError that names file, line and what is wrong.
Polyline read_centerline(const std::filesystem::path& file);

double arc_length(const Polyline& line);

/// `parts` + 1 points at almost equal distances on a cubic spline through those of the line that
/// are at least `shortest` from each other along it (the noise of nearer ones would make it wave).
Polyline evenly_spaced(const Polyline& line, double shortest, int parts);

/// Moves the first point to the origin and turns the end-to-end direction to +z.
void align_with_z(Polyline& line);

}  // namespace bight::coupling
