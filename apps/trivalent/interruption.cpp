#include "interruption.h"

#include <unistd.h>

#include <atomic>
#include <csignal>
#include <string_view>

#include "trivalent/remesh/whole_file.h"

namespace trivalent::apps {
namespace {

// A handler of signals reaches nothing but globals.
// NOLINTBEGIN(cppcoreguidelines-avoid-non-const-global-variables)
std::atomic<bool> may_stop = false;  ///< a StopRequest lives
std::atomic<int> stop_signal = 0;    ///< that asked for the stop
// NOLINTEND(cppcoreguidelines-avoid-non-const-global-variables)
static_assert(std::atomic<int>::is_always_lock_free);

void say(std::string_view text) {
  // Nobody is left to be told if this fails.
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, text.data(), text.size());
}

extern "C" void on_interruption(int signal) {
  if (may_stop && stop_signal.exchange(signal) == 0) {
    say("\nstopping and keeping what there is; once more ends at once\n");
    return;
  }
  remesh::remove_part_files();
  // The parent shall see that a signal ended us: a shell's loop then ends too.
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

}  // namespace

void handle_interruptions() {
  struct sigaction action = {};
  action.sa_handler = on_interruption;
  action.sa_flags = SA_RESTART;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction before = {};
    sigaction(signal, nullptr, &before);
    // Under nohup or in the background the signal is not meant for us.
    if (before.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr);
  }
  std::signal(SIGXFSZ, SIG_IGN);
}

StopRequest::StopRequest() {
  stop_signal = 0;
  may_stop = true;
}

StopRequest::~StopRequest() { may_stop = false; }

bool StopRequest::is_made() const { return stop_signal != 0; }

int StopRequest::exit_code() const { return is_made() ? 128 + stop_signal : 0; }

}  // namespace trivalent::apps
