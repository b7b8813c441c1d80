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

  /// A signal has come since the object was made.
  [[nodiscard]] bool is_made() const;
  /// 128 + the number of the signal, as shells count; 0 if there was none.
  [[nodiscard]] int exit_code() const;
};

}  // namespace trivalent::apps
