#include "remesh_options.h"

#include <charconv>
#include <cmath>
#include <numbers>

#include "trivalent/shell/option_names.h"

namespace trivalent::apps {
namespace {

enum class Method { crystal, paper };

constexpr shell::Names<Method, 2> methods = {
    {{"crystal", Method::crystal}, {"paper", Method::paper}}};

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

/// A name, or a stiffness.
void set_follow(const Session& session, remesh::CrystalOptions& options) {
  const auto& text = session.get<std::string>("follow");
  double stiffness = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), stiffness);
  if (error != std::errc{} || end != text.data() + text.size()) {
    options.follow = named_value(session, "follow", shell::follow_names);
    return;
  }
  if (!(stiffness > 0.0) || !std::isfinite(stiffness)) {
    throw UsageError("--follow: a stiffness must be > 0");
  }
  options.stiffness = stiffness;
}

remesh::CrystalOptions crystal_options(const Session& session) {
  refuse_options(session, {"iterations", "rings", "sigma", "restriction"});
  if (session.get<int>("seed") < 0) throw UsageError("--seed must not be negative");
  remesh::CrystalOptions options;
  options.effort = named_value(session, "effort", shell::effort_names);
  set_follow(session, options);
  options.seed = static_cast<std::uint64_t>(session.get<int>("seed"));
  return options;
}

remesh::RemeshOptions paper_options(const Session& session) {
  refuse_options(session, {"effort", "follow", "seed"});
  remesh::RemeshOptions options;
  options.iterations = session.get<int>("iterations");
  options.rings = session.get<int>("rings");
  options.tolerance = session.get<double>("sigma");
  options.restriction = named_value(session, "restriction", shell::restriction_names);
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
      ("method", with_default_name(Method::crystal, methods),
       "crystal: few defects, where curvature wants them; paper: split, collapse, flip, relax, "
       "project")  //
      ("effort", with_default_name(remesh::Effort::normal, shell::effort_names),
       "crystal: how long to search, quick, normal or thorough")  //
      ("follow", with_default_name(remesh::Follow::carbon, shell::follow_names),
       "crystal: how strongly the net is held to the surface: close, carbon (as far as a shell at "
       "rest moves away), free (lowest energy), or a stiffness in eV/Å² for each ring: 0.02 is "
       "about "
       "close, 0.006 carbon, 0.002 free")                        //
      ("seed", with_default(0), "crystal: of the random moves")  //
      ("feature-angle", po::value<double>(),
       "edges sharper than this [degrees] are creases and stay; default: none are")  //
      ("iterations", with_default(defaults.iterations), "paper: n, 1 to 1000")       //
      ("rings", with_default(defaults.rings),
       "paper: k, 1 to 8, rings of neighbors in the relaxation")  //
      ("sigma", with_default(defaults.tolerance),
       "paper: edges within this fraction of the target length are left alone, between 0 and 1")  //
      ("restriction", with_default_name(defaults.restriction, shell::restriction_names),
       "paper: how vertices are kept in their tangent planes: hard or least-squares");
}

remesh::RemeshMethod remesh_method(const Session& session) {
  return named_value(session, "method", methods) == Method::crystal
             ? completed(crystal_options(session), session)
             : completed(paper_options(session), session);
}

void stop_with(remesh::RemeshMethod& method, const StopRequest& stop) {
  stop.answer_in_time();
  std::visit([&](auto& options) { options.should_stop = [&stop] { return stop.is_made(); }; },
             method);
}

}  // namespace trivalent::apps
