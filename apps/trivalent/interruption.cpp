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
std::atomic<bool> may_stop = false;   ///< a StopRequest lives
std::atomic<int> stop_signal = 0;     ///< that asked for the stop
std::atomic<bool> is_urgent = false;  ///< the answer to a signal must come in time
// NOLINTEND(cppcoreguidelines-avoid-non-const-global-variables)
static_assert(std::atomic<int>::is_always_lock_free);

void say(std::string_view text) {
  // Nobody is left to be told if this fails.
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, text.data(), text.size());
}

void end_by(int signal) {
  remesh::remove_part_files();
  // The parent shall see that a signal ended us: a shell's loop then ends too.
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

extern "C" void on_interruption(int signal) {
  if (!may_stop || stop_signal.exchange(signal) != 0) return end_by(signal);
  // Who presses Ctrl-C can press it again.
  if (signal == SIGINT || !is_urgent) {
    say("\nstopping and keeping what there is; once more ends at once\n");
  } else {
    constexpr unsigned seconds = 2;
    say("\nstopping; what is finished in 2 s is kept\n");
    ::alarm(seconds);
  }
}

extern "C" void on_deadline(int /*signal*/) {
  if (!is_urgent) return;
  say("\nstopped before anything was finished; nothing is kept\n");
  end_by(stop_signal);
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
  action.sa_handler = on_deadline;
  sigaction(SIGALRM, &action, nullptr);
  std::signal(SIGXFSZ, SIG_IGN);
}

int interruption_exit_code() { return stop_signal != 0 ? 128 + stop_signal : 0; }

StopRequest::StopRequest() {
  stop_signal = 0;
  is_urgent = false;
  may_stop = true;
}

StopRequest::~StopRequest() {
  keep_results();
  may_stop = false;
}

void StopRequest::answer_in_time() const { is_urgent = true; }

void StopRequest::keep_results() const {
  is_urgent = false;
  ::alarm(0);
}

bool StopRequest::is_made() const { return stop_signal != 0; }

}  // namespace trivalent::apps
