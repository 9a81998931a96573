#pragma once

#include "solid3d/effects.h"
#include "solid3d/mesh.h"
#include "solid3d/run_solid.h"

namespace bight::solid3d {

/// Mean of the centre points of each section [D].
Polyline centerline(const Mesh& mesh, const Vector& x);

/// Turn of the tangent by undeformed arc length s, |r' x r''|/|r'|^2 of the parabola through three
/// points: what bends a rod, whatever its stretch. One-sided at the ends.
std::vector<double> curvature(const Polyline& line, const std::vector<double>& s);

/// The largest 1 - w/w0 of each section, w its width between parallel lines in its plane and w0
/// that of the undeformed section between lines in the same direction.
std::vector<double> flattening(const Mesh& mesh, const Vector& x);

/// Resultants at all sections, about their centres: nodal forces of the cells before a section and
/// minus those of the cells behind it, their mean (contact acts on the section's own nodes). At the
/// ends, of the cells that there are; in the middle of a quadratic cell, the mean of what its two
/// ends carry. For one strand whose effects are those of the whole of it.
SectionLoads section_loads(const Mesh& mesh, const SolidEffects& effects, const Vector& x);

/// Everything the writers show of a state, but tension and energies.
SolidState fields(const Mesh& mesh, const SolidEffects& effects, const Vector& x);

}  // namespace bight::solid3d
