#include "coupling/interrupt.h"

#include <signal.h>
#include <unistd.h>

namespace bight::coupling {
namespace {

constexpr unsigned patience = 10;  // seconds that a step may still take after an interrupt

volatile sig_atomic_t asked_to_stop = 0;

void leave(int) { _exit(130); }

void ask_to_stop(int) {
  if (asked_to_stop) _exit(130);
  asked_to_stop = 1;
  alarm(patience);
}

}  // namespace

void catch_interrupts() {
  signal(SIGINT, ask_to_stop);
  signal(SIGTERM, ask_to_stop);
  signal(SIGALRM, leave);
}

bool interrupted() { return asked_to_stop != 0; }

}  // namespace bight::coupling
