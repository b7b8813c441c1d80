#pragma once

namespace trivalent::apps {

/// From here on Ctrl-C (SIGINT), SIGTERM and SIGHUP remove unfinished files before they end the
/// program; a shell sees exit code 130, 143 or 129. A file that grows too large (SIGXFSZ) becomes
/// an error of writing it.
///
/// Work that has something to show for its time can stop early instead and keep what it has:
///
///     const StopRequest stop;  // while it lives, the first signal only asks; the second ends
///     options.on_progress = [&](const auto& state) { return !stop.is_made(); };
///     ... write the results as usual ...
///     return stop.exit_code();
void handle_interruptions();

/// 128 + the number of the signal that asked the last StopRequest, as shells count; 0 if none did.
[[nodiscard]] int interruption_exit_code();

/// Whether the user wants the work to come to an end. One at a time, in the main thread; any thread
/// may ask.
class StopRequest {
 public:
  StopRequest();
  StopRequest(const StopRequest&) = delete;
  StopRequest(StopRequest&&) = delete;
  StopRequest& operator=(const StopRequest&) = delete;
  StopRequest& operator=(StopRequest&&) = delete;
  ~StopRequest();

  /// Until keep_results(), the program ends without results 2 s after a signal other than Ctrl-C,
  /// unless the work has ended by then: a job that is told to end is soon killed.
  void answer_in_time() const;
  /// The results are known and only need to be written, which may take longer.
  void keep_results() const;

  /// A signal has come since the object was made.
  [[nodiscard]] bool is_made() const;
  [[nodiscard]] int exit_code() const { return interruption_exit_code(); }
};

}  // namespace trivalent::apps
