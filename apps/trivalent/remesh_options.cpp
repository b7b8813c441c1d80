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

}  // namespace

void add_remesh_options(po::options_description& options) {
  const remesh::RemeshOptions defaults;
  options.add_options()  //
      ("method", with_default(std::string("paper")),
       "paper: split, collapse, flip, relax, project")                                            //
      ("iterations", with_default(defaults.iterations), "n, 1 to 1000")                           //
      ("rings", with_default(defaults.rings), "k, 1 to 8: rings of neighbors in the relaxation")  //
      ("sigma", with_default(defaults.tolerance),
       "edges within this fraction of the target length are left alone, between 0 and 1")  //
      ("restriction", with_default(std::string(name_of(defaults.restriction))),
       "how vertices are kept in their tangent planes: hard or least-squares")  //
      ("feature-angle", po::value<double>(),
       "edges sharper than this [degrees] are creases and stay; default: none are")  //
      ("seed", with_default(0), "of random numbers; the paper's method draws none");
}

remesh::RemeshOptions remesh_options(const Session& session) {
  const auto& method = session.get<std::string>("method");
  if (method != "paper") throw UsageError("--method is paper, not '" + method + "'");
  remesh::RemeshOptions options;
  options.iterations = session.get<int>("iterations");
  options.rings = session.get<int>("rings");
  options.tolerance = session.get<double>("sigma");
  options.restriction = restriction_called(session.get<std::string>("restriction"));
  if (const auto degrees = session.find<double>("feature-angle")) {
    if (!(*degrees > 0.0 && *degrees < 180.0)) {
      throw UsageError("--feature-angle must lie between 0 and 180 degrees");
    }
    options.feature_angle = *degrees * std::numbers::pi / 180.0;
  }
  options.on_progress = [&session](const remesh::RemeshProgress& state) {
    session.terminal.progress(state);
  };
  return options;
}

}  // namespace trivalent::apps
