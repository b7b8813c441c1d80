#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <vector>

#include "crystal/membrane.h"
#include "trivalent/remesh/lattice.h"

namespace trivalent::remesh {

/// Numbers for the images of vertices that an energy's terms reach through the faces of a cell.
/// Terms see an image as a vertex of its own, which moves with the vertex it is an image of.
class VertexImages {
 public:
  /// @param vertices  Their numbers are 0 to vertices - 1; images get those that follow.
  explicit VertexImages(std::size_t vertices) : vertices_(vertices) {}

  /// The number of an image, new or known; the vertex itself where the image is zero.
  [[nodiscard]] int number(int vertex, const Lattice::Image& image) {
    if (image == Lattice::Image{0, 0, 0}) return vertex;
    const auto next = static_cast<int>(vertices_ + images_.size());
    const auto [entry, is_new] = numbers_.try_emplace({vertex, image[0], image[1], image[2]}, next);
    if (is_new) images_.push_back({vertex, image});
    return entry->second;
  }

  /// The vertex that a number stands for.
  [[nodiscard]] int vertex_of(int number) const {
    const auto i = static_cast<std::size_t>(number);
    return i < vertices_ ? number : images_[i - vertices_].vertex;
  }

  /// Adds the positions of the images, as long as there are any, to those of the vertices.
  template <typename Scalar>
  void place(const Lattice& lattice, std::vector<Lanes<Scalar>>& x) const {
    x.resize(vertices_ + images_.size());
    for (std::size_t k = 0; k < images_.size(); ++k) {
      const Eigen::Vector3d t = lattice.translation(images_[k].image);
      x[vertices_ + k] = x[static_cast<std::size_t>(images_[k].vertex)] +
                         Eigen::Vector4d(t.x(), t.y(), t.z(), 0.0).cast<Scalar>();
    }
  }

  /// Adds the gradient by positions of images to that by positions of their vertices.
  template <typename Scalar>
  void collect(std::vector<Lanes<Scalar>>& gradient) const {
    for (std::size_t k = 0; k < images_.size(); ++k) {
      gradient[static_cast<std::size_t>(images_[k].vertex)] += gradient[vertices_ + k];
    }
  }

 private:
  struct VertexImage {
    int vertex;
    Lattice::Image image;
  };
  std::size_t vertices_;
  std::vector<VertexImage> images_;
  std::map<std::array<int, 4>, int> numbers_;
};

}  // namespace trivalent::remesh
