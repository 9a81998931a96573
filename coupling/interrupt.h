#pragma once

namespace bight::coupling {

/// From now on the first interrupt (Ctrl-C, kill) only asks the run to stop after its step.
void catch_interrupts();
bool interrupted();

}  // namespace bight::coupling
