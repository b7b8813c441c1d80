#include "surface_input.h"

namespace trivalent::apps {
namespace {

using remesh::ComponentPolicy;
using remesh::HolePolicy;
using remesh::RepairMethod;

RepairMethod method_called(const std::string& name) {
  if (name == "none") return RepairMethod::none;
  if (name == "safe") return RepairMethod::safe;
  if (name == "wrap") return RepairMethod::wrap;
  throw UsageError("--repair is none, safe or wrap, not '" + name + "'");
}

HolePolicy holes_called(const std::string& name) {
  if (name == "keep") return HolePolicy::keep;
  if (name == "fill") return HolePolicy::fill;
  throw UsageError("--holes is keep or fill, not '" + name + "'");
}

ComponentPolicy components_called(const std::string& name) {
  if (name == "all") return ComponentPolicy::keep_all;
  if (name == "largest") return ComponentPolicy::keep_largest;
  throw UsageError("--components is all or largest, not '" + name + "'");
}

}  // namespace

void add_repair_options(po::options_description& options) {
  options.add_options()  //
      ("repair", with_default(std::string("safe")),
       "safe: mends what can be mended without changing the shape; none: refuses what is not sound;"
       " wrap: a new closed surface a small distance outside of everything, for scans, soups and "
       "points")                                                                    //
      ("holes", with_default(std::string("keep")), "keep, or fill all")             //
      ("components", with_default(std::string("all")), "all, or only the largest")  //
      ("wrap-alpha", po::value<double>(),
       "size of the gaps that a wrap closes, in units of the input; default: 1/100 of its "
       "diagonal, more among sparse points")  //
      ("wrap-offset", po::value<double>(),
       "distance of a wrap from the input, in its units; default: 1/30 of alpha, or an edge of the "
       "net where the wrap would be thinner than that, as of an open surface");
}

remesh::RepairOptions repair_options(const Session& session) {
  return {.method = method_called(session.get<std::string>("repair")),
          .holes = holes_called(session.get<std::string>("holes")),
          .components = components_called(session.get<std::string>("components")),
          .wrap_alpha = session.find<double>("wrap-alpha"),
          .wrap_offset = session.find<double>("wrap-offset")};
}

remesh::TriangleSoup read_soup(const std::string& path) {
  return remesh::triangulate(remesh::read_polygon_soup(path == "-" ? "/dev/stdin" : path));
}

remesh::RepairResult read_surface(const std::string& path, const Session& session,
                                  std::function<double(const remesh::TriMesh&)> edge_length_on) {
  remesh::RepairOptions options = repair_options(session);
  options.edge_length_on = std::move(edge_length_on);
  return remesh::repair(read_soup(path), options);
}

}  // namespace trivalent::apps
