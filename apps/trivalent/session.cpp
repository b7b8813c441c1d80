#include "session.h"

#include <iostream>

namespace trivalent::apps {
namespace {

po::options_description common_options() {
  po::options_description options("Common options");
  options.add_options()                                                                        //
      ("json", "print the result as one JSON object on standard output")                       //
      ("quiet", "no progress and no remarks")                                                  //
      ("threads", po::value<int>(), "number of threads, at least 1; default: all processors")  //
      ("help", "print this help");
  return options;
}

void print_help(const Command& command, const Grammar& grammar) {
  std::cout << "Usage: trivalent " << command.name << ' ' << command.synopsis << "\n\n"
            << command.meaning << ".\n\n"
            << grammar.options << '\n'
            << common_options();
  if (!grammar.epilog.empty()) std::cout << '\n' << grammar.epilog;
}

po::variables_map parse(const Grammar& grammar, std::span<const std::string> arguments) {
  po::options_description all;
  all.add(grammar.options).add(common_options());
  po::positional_options_description positions;
  for (const std::string& name : grammar.arguments) {
    all.add_options()(name.c_str(), po::value<std::string>());
    positions.add(name.c_str(), 1);
  }
  if (!grammar.list.empty()) {
    all.add_options()(grammar.list.c_str(), po::value<std::vector<std::string>>());
    positions.add(grammar.list.c_str(), -1);
  }
  // An abbreviated option would change its meaning whenever a new one appears.
  const int style = po::command_line_style::unix_style & ~po::command_line_style::allow_guessing;
  const std::vector<std::string> words(arguments.begin(), arguments.end());
  po::variables_map values;
  po::store(po::command_line_parser(words).options(all).positional(positions).style(style).run(),
            values);
  return values;
}

std::unique_ptr<tbb::global_control> limit_threads(const po::variables_map& values) {
  if (values.count("threads") == 0) return nullptr;
  const int threads = values["threads"].as<int>();
  if (threads < 1) throw UsageError("--threads must be at least 1");
  return std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                               static_cast<std::size_t>(threads));
}

}  // namespace

std::optional<Session> start(const Command& command, std::span<const std::string> arguments,
                             const Grammar& grammar) {
  po::variables_map values = parse(grammar, arguments);
  if (values.count("help") > 0) {
    print_help(command, grammar);
    return std::nullopt;
  }
  std::vector<std::string> required = grammar.arguments;
  if (!grammar.list.empty()) required.push_back(grammar.list);
  for (const std::string& name : required) {
    if (values.count(name) > 0 || name == grammar.optional_argument) continue;
    throw UsageError("missing " + name + "; usage: trivalent " + std::string(command.name) + ' ' +
                     std::string(command.synopsis));
  }
  auto thread_limit = limit_threads(values);
  const Terminal terminal(values.count("quiet") > 0 ? Remarks::none : Remarks::all,
                          values.count("json") > 0 ? ResultKind::json : ResultKind::table);
  return Session{std::move(values), terminal, std::move(thread_limit)};
}

Json options_json(const Session& session) {
  Json json = Json::object();
  for (const auto& [name, value] : session.values) {
    if (const auto* text = boost::any_cast<std::string>(&value.value())) json[name] = *text;
    if (const auto* number = boost::any_cast<double>(&value.value())) json[name] = *number;
    if (const auto* count = boost::any_cast<int>(&value.value())) json[name] = *count;
    if (const auto* counts = boost::any_cast<std::vector<int>>(&value.value())) {
      json[name] = *counts;
    }
  }
  return json;
}

}  // namespace trivalent::apps
