#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <exception>
#include <functional>
#include <memory>
#include <thread>
#include <utility>
#include <vector>

/// Stands in for oneTBB where the thread sanitizer looks: Debian's oneTBB is not instrumented, so
/// that the sanitizer does not see what its tasks wait for and reports races everywhere. Here every
/// loop starts threads and joins them, and neighbors of a loop go to different threads.
namespace tbb {

/// A loop inside of a loop stays on its thread.
inline thread_local int this_thread = -1;  // in a loop: 0, 1, ...

class global_control {
 public:
  enum parameter { max_allowed_parallelism };
  global_control(parameter, std::size_t threads) : before_(std::exchange(threads_, threads)) {}
  ~global_control() { threads_ = before_; }
  global_control(const global_control&) = delete;
  global_control& operator=(const global_control&) = delete;
  static constexpr std::size_t max_threads = 8;
  static int threads() {
    return static_cast<int>(std::clamp<std::size_t>(threads_, 1, max_threads));
  }

 private:
  static inline std::size_t threads_ = 4;
  std::size_t before_;
};

/// Calls body(t) for t = 0, 1, ... < threads, each on a thread of its own; throws what one of them
/// throws.
template <typename Body>
void on_each_thread(int threads, const Body& body) {
  std::vector<std::exception_ptr> errors(static_cast<std::size_t>(threads));
  std::vector<std::thread> running;
  for (int t = 0; t < threads; ++t) {
    running.emplace_back([&, t] {
      this_thread = t;
      try {
        body(t);
      } catch (...) {
        errors[static_cast<std::size_t>(t)] = std::current_exception();
      }
    });
  }
  for (std::thread& thread : running) thread.join();
  for (const std::exception_ptr& error : errors) {
    if (error) std::rethrow_exception(error);
  }
}

template <typename Index, typename Body>
void parallel_for(Index first, Index last, const Body& body) {
  if (this_thread >= 0) {
    for (Index i = first; i < last; ++i) body(i);
    return;
  }
  const int threads = global_control::threads();
  on_each_thread(threads, [&](int t) {
    for (Index i = first + static_cast<Index>(t); i < last; i += static_cast<Index>(threads))
      body(i);
  });
}

template <typename Index>
class blocked_range {
 public:
  blocked_range(Index begin, Index end, std::size_t /*grain*/ = 1) : begin_(begin), end_(end) {}
  [[nodiscard]] Index begin() const { return begin_; }
  [[nodiscard]] Index end() const { return end_; }

 private:
  Index begin_;
  Index end_;
};

/// A range in eight pieces.
template <typename Index>
std::vector<blocked_range<Index>> pieces_of(const blocked_range<Index>& range) {
  constexpr Index count = 8;
  const Index size = range.end() - range.begin();
  std::vector<blocked_range<Index>> pieces;
  for (Index i = 0; i < count; ++i) {
    const blocked_range<Index> piece(range.begin() + size * i / count,
                                     range.begin() + size * (i + 1) / count);
    if (piece.begin() < piece.end()) pieces.push_back(piece);
  }
  return pieces;
}

template <typename Index, typename Body>
void parallel_for(const blocked_range<Index>& range, const Body& body) {
  const auto pieces = pieces_of(range);
  parallel_for(std::size_t{0}, pieces.size(), [&](std::size_t i) { body(pieces[i]); });
}

template <typename Index, typename Value, typename Body, typename Join>
Value parallel_reduce(const blocked_range<Index>& range, const Value& identity, const Body& body,
                      const Join& join) {
  const auto pieces = pieces_of(range);
  std::vector<Value> values(pieces.size(), identity);
  parallel_for(std::size_t{0}, pieces.size(),
               [&](std::size_t i) { values[i] = body(pieces[i], std::move(values[i])); });
  Value sum = identity;
  for (Value& value : values) sum = join(std::move(sum), std::move(value));
  return sum;
}

template <typename... Tasks>
void parallel_invoke(const Tasks&... tasks) {
  const std::array<std::function<void()>, sizeof...(Tasks)> all = {tasks...};
  parallel_for(std::size_t{0}, all.size(), [&](std::size_t i) { all[i](); });
}

template <typename Iterator, typename... Compare>
void parallel_sort(Iterator begin, Iterator end, const Compare&... compare) {
  std::sort(begin, end, compare...);
}

template <typename Value>
class enumerable_thread_specific {
 public:
  Value& local() {
    std::unique_ptr<Value>& value = values_[static_cast<std::size_t>(this_thread + 1)];
    if (!value) value = std::make_unique<Value>();
    return *value;
  }

 private:
  std::array<std::unique_ptr<Value>, global_control::max_threads + 1> values_;
};

}  // namespace tbb
