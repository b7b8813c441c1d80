#pragma once

#include <optional>

#include "crystal/spring_search.h"

namespace trivalent::remesh {

/// The ground state of a membrane near a surface, searched for by annealing: at sixteen, eight,
/// four or two times the target length, as long as the surface is thick and large enough for; then
/// divided and annealed colder at half the length each time, or divided at once with its
/// disclinations where the membrane wants them. Its vertices are where the membrane is at rest.
///
/// @return  Nothing where the surface is too thin for a net of twice the target length, or if the
///   search was stopped before there was a net.
[[nodiscard]] std::optional<FoundNet> search_membrane(const SearchSurface& surface,
                                                      const CrystalOptions& options,
                                                      SearchWatch& watch);

}  // namespace trivalent::remesh
