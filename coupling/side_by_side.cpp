#include "coupling/side_by_side.h"

#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <map>

#include "coupling/errors.h"
#include "coupling/interrupt.h"

namespace bight::coupling {
namespace {

constexpr unsigned glance = 10'000;  // microseconds between two looks at what has ended

// A group of its own: Ctrl-C reaches the children through us alone, once.
pid_t begin(const Words& words) {
  std::vector<char*> pointers;
  for (const std::string& word : words) pointers.push_back(const_cast<char*>(word.c_str()));
  pointers.push_back(nullptr);
  const pid_t parent = getpid(), child = fork();
  if (child < 0) throw FileError("no process can be begun: " + std::string(std::strerror(errno)));
  if (child > 0) return child;
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGTERM);  // not to outlive us
  if (getppid() != parent) _exit(130);
  execv(pointers[0], pointers.data());
  _exit(127);
}

int exit_status(int status) {
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace

bool run_side_by_side(const std::vector<Words>& programs, int at_once,
                      const std::function<void(size_t, int)>& ended) {
  std::map<pid_t, size_t> running;
  size_t next = 0;
  bool asked = false;
  while (!running.empty() || (next < programs.size() && !interrupted())) {
    while (next < programs.size() && static_cast<int>(running.size()) < at_once && !interrupted()) {
      const pid_t child = begin(programs[next]);
      running[child] = next++;
    }
    if (interrupted() && !asked) {
      for (const auto& [child, index] : running) kill(child, SIGTERM);
      asked = true;
    }
    bool any = false;
    for (auto it = running.begin(); it != running.end();) {
      int status = 0;
      const bool over = waitpid(it->first, &status, WNOHANG) == it->first;
      any = any || over;
      if (over && !asked) ended(it->second, exit_status(status));
      it = over ? running.erase(it) : std::next(it);
    }
    if (!any) usleep(glance);
  }
  return !interrupted();
}

std::string shell_line(const Words& words) {
  std::string line;
  for (const std::string& word : words) {
    std::string quoted = "'";
    for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    line += (line.empty() ? "" : " ") + quoted + "'";
  }
  return line;
}

}  // namespace bight::coupling
