#pragma once

#include <filesystem>

#include "mechanics/types.h"

namespace bight::coupling {

/// Reads a centerline [m]: CSV with columns x, y, z (by name when there is a header line), or rows
/// of numbers x y z ... parted by blanks. Lines that begin with # are comments. Throws InputError
/// that names file, line and what is wrong.
Polyline read_centerline(const std::filesystem::path& file);

double arc_length(const Polyline& line);

/// Moves the first point to the origin and turns the end-to-end direction to +z.
void align_with_z(Polyline& line);

}  // namespace bight::coupling
