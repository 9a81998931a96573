#pragma once

namespace bight::coupling {

/// From now on the first interrupt (Ctrl-C, kill) asks the run to stop after its step. A second
/// one, or a step that goes on for more than ten seconds, ends the program at once with status 130;
/// files are valid all the same, since they only ever change as a whole or by whole rows.
void catch_interrupts();
bool interrupted();

}  // namespace bight::coupling
