#include "remesh_options.h"

#include <numbers>

namespace trivalent::apps {
namespace {

constexpr const char* hard = "hard";
constexpr const char* least_squares = "least-squares";

const char* name_of(remesh::Restriction restriction) {
  return restriction == remesh::Restriction::hard ? hard : least_squares;
}

remesh::Restriction restriction_called(const std::string& name) {
  if (name == hard) return remesh::Restriction::hard;
  if (name == least_squares) return remesh::Restriction::least_squares;
  throw UsageError("--restriction is hard or least-squares, not '" + name + "'");
}

remesh::Effort effort_called(const std::string& name) {
  if (name == "quick") return remesh::Effort::quick;
  if (name == "normal") return remesh::Effort::normal;
  if (name == "thorough") return remesh::Effort::thorough;
  throw UsageError("--effort is quick, normal or thorough, not '" + name + "'");
}

std::optional<double> feature_angle(const Session& session) {
  const auto degrees = session.find<double>("feature-angle");
  if (!degrees) return std::nullopt;
  if (!(*degrees > 0.0 && *degrees < 180.0)) {
    throw UsageError("--feature-angle must lie between 0 and 180 degrees");
  }
  return *degrees * std::numbers::pi / 180.0;
}

/// Options of the method that was not chosen would have no effect.
void refuse_options(const Session& session, std::initializer_list<const char*> names) {
  for (const char* name : names) {
    if (session.values[name].empty() || session.values[name].defaulted()) continue;
    throw UsageError(std::string("--") + name + " has no effect with --method " +
                     session.get<std::string>("method"));
  }
}

remesh::CrystalOptions crystal_options(const Session& session, std::optional<StopRequest>& stop) {
  refuse_options(session, {"iterations", "rings", "sigma", "restriction"});
  if (session.get<int>("seed") < 0) throw UsageError("--seed must not be negative");
  remesh::CrystalOptions options;
  options.effort = effort_called(session.get<std::string>("effort"));
  options.seed = static_cast<std::uint64_t>(session.get<int>("seed"));
  stop.emplace();
  stop->answer_in_time();
  options.should_stop = [&stop] { return stop->is_made(); };
  return options;
}

remesh::RemeshOptions paper_options(const Session& session) {
  refuse_options(session, {"effort", "seed"});
  remesh::RemeshOptions options;
  options.iterations = session.get<int>("iterations");
  options.rings = session.get<int>("rings");
  options.tolerance = session.get<double>("sigma");
  options.restriction = restriction_called(session.get<std::string>("restriction"));
  return options;
}

template <typename Options>
remesh::RemeshMethod completed(Options options, const Session& session) {
  options.feature_angle = feature_angle(session);
  options.on_progress = [&session](const remesh::RemeshProgress& state) {
    session.terminal.progress(state);
  };
  return options;
}

}  // namespace

void add_remesh_options(po::options_description& options) {
  const remesh::RemeshOptions defaults;
  options.add_options()  //
      ("method", with_default(std::string("crystal")),
       "crystal: few defects, where curvature wants them; paper: split, collapse, flip, relax, "
       "project")  //
      ("effort", with_default(std::string("normal")),
       "crystal: how long to search, quick, normal or thorough")  //
      ("seed", with_default(0), "crystal: of the random moves")   //
      ("feature-angle", po::value<double>(),
       "edges sharper than this [degrees] are creases and stay; default: none are")  //
      ("iterations", with_default(defaults.iterations), "paper: n, 1 to 1000")       //
      ("rings", with_default(defaults.rings),
       "paper: k, 1 to 8, rings of neighbors in the relaxation")  //
      ("sigma", with_default(defaults.tolerance),
       "paper: edges within this fraction of the target length are left alone, between 0 and 1")  //
      ("restriction", with_default(std::string(name_of(defaults.restriction))),
       "paper: how vertices are kept in their tangent planes: hard or least-squares");
}

remesh::RemeshMethod remesh_method(const Session& session, std::optional<StopRequest>& stop) {
  const auto& method = session.get<std::string>("method");
  if (method == "crystal") return completed(crystal_options(session, stop), session);
  if (method == "paper") return completed(paper_options(session), session);
  throw UsageError("--method is crystal or paper, not '" + method + "'");
}

std::string stopped_note(const remesh::RemeshResult& result) {
  return "stopped after " + std::to_string(result.iterations) +
         " rounds, as asked; this is the best net so far";
}

}  // namespace trivalent::apps
