#pragma once

#include <string>

#include "coupling/scene.h"

namespace bight::coupling {

/// For `bight check`: the effects that will be simulated, with the unknowns and memory expected.
std::string expectations(const Scene& scene);

}  // namespace bight::coupling
