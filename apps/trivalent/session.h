#pragma once

#include <tbb/global_control.h>

#include <boost/program_options.hpp>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "command.h"
#include "terminal.h"
#include "trivalent/shell/names.h"

namespace trivalent::apps {

namespace po = boost::program_options;

/// The command line asks for something that does not exist or does not fit together: exit code 2.
struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// What a subcommand takes: its arguments by position, and its options.
struct Grammar {
  std::vector<std::string> arguments;  ///< all required, but for optional_argument
  po::options_description options;
  std::string epilog = {};  ///< printed after the options in --help
  std::string optional_argument = {};
  std::string list = {};  ///< name of an argument that follows and may be repeated, at least one
};

/// A subcommand at work: what it was told, where it talks, and how many threads it has.
struct Session {
  po::variables_map values;
  Terminal terminal;
  std::unique_ptr<tbb::global_control> thread_limit;

  [[nodiscard]] bool has(const std::string& name) const { return values.count(name) > 0; }
  template <typename Value>
  [[nodiscard]] const Value& get(const std::string& name) const {
    return values[name].as<Value>();
  }
  template <typename Value>
  [[nodiscard]] std::optional<Value> find(const std::string& name) const {
    return has(name) ? std::optional<Value>(get<Value>(name)) : std::nullopt;
  }
};

/// Reads the arguments of a subcommand; --json, --quiet, --threads and --help are added to its
/// options. Returns none after printing the help that was asked for.
///
/// @throws UsageError, boost::program_options::error on a command line that makes no sense.
[[nodiscard]] std::optional<Session> start(const Command& command,
                                           std::span<const std::string> arguments,
                                           const Grammar& grammar);

/// The options that were given or have a default, by name; flags are left out.
[[nodiscard]] Json options_json(const Session& session);

/// An option's value with a default that --help shows as a person would write it.
template <typename Value>
[[nodiscard]] po::typed_value<Value>* with_default(const Value& value) {
  std::ostringstream text;
  text << value;
  return po::value<Value>()->default_value(value, text.str());
}

/// The same for an option that takes a name out of a table.
template <typename Value, std::size_t n>
[[nodiscard]] po::typed_value<std::string>* with_default_name(Value value,
                                                              const shell::Names<Value, n>& names) {
  return with_default(std::string(shell::name_of(value, names)));
}

/// The value that an option names.
///
/// @throws UsageError if the table lacks the name.
template <typename Value, std::size_t n>
[[nodiscard]] Value named_value(const Session& session, const std::string& option,
                                const shell::Names<Value, n>& names) {
  const auto& name = session.get<std::string>(option);
  if (const auto value = shell::value_named(name, names)) return *value;
  throw UsageError("--" + option + " is " + shell::list_of(names) + ", not '" + name + "'");
}

}  // namespace trivalent::apps
