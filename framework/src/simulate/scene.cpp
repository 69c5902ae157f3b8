// SPDX-License-Identifier: BSD-3-Clause
#include "simulate/scene.hpp"

#include <algorithm>
#include <cmath>

namespace cambium::simulate {

Scene::Scene(const Terrain& terrain, const std::vector<Stem>& stems,
             const std::vector<Stem>& clutter, const Foliage& foliage)
    : corner_(float(terrain.x0), float(terrain.y0)),
      nx_(terrain.nx),
      ny_(terrain.ny),
      ground_(terrain.heights),
      columns_(std::size_t(nx_) * std::size_t(ny_)),
      stem_count_(stems.size()) {
  for (int iy = 0; iy < ny_; ++iy)
    for (int ix = 0; ix < nx_; ++ix)
      columns_[std::size_t(iy * nx_ + ix)].ground =
          std::max({terrain.at(ix, iy), terrain.at(ix + 1, iy), terrain.at(ix, iy + 1),
                    terrain.at(ix + 1, iy + 1)});
  add_cones(stems);
  add_cones(clutter);
  index_cones();
  take_foliage(foliage);
  for (const Column& c : columns_)
    top_ =
        std::max({top_, c.ground, c.top, layer_zero_ + float(c.leaf_end) * float(Terrain::cell)});
}

void Scene::add_cones(const std::vector<Stem>& stems) {
  const Vec3 corner(corner_.x(), corner_.y(), 0);
  for (const Stem& s : stems)
    cones_.push_back({(s.base - corner).cast<float>(), s.axis.cast<float>(), float(s.radius_at(0)),
                      float(s.height)});
}

void Scene::index_cones() {
  // A cone touches the columns that its discs touch, one disc every half metre.
  std::vector<std::vector<std::uint32_t>> lists(columns_.size());
  for (std::uint32_t c = 0; c < cones_.size(); ++c) {
    const Cone& cone = cones_[c];
    constexpr float step = 0.5f;
    for (float s = 0; s <= cone.length + step; s += step) {
      const float along = std::min(s, cone.length);
      const Eigen::Vector3f center = cone.base + along * cone.axis;
      const Eigen::Vector2f p = center.head<2>();
      const float reach = cone.radius + 0.5f * step * cone.axis.head<2>().norm() + 1e-3f;
      for (int iy = int(std::floor(p.y() - reach)); iy <= int(std::floor(p.y() + reach)); ++iy)
        for (int ix = int(std::floor(p.x() - reach)); ix <= int(std::floor(p.x() + reach)); ++ix) {
          if (ix < 0 || iy < 0 || ix >= nx_ || iy >= ny_) continue;
          const auto column = std::size_t(iy * nx_ + ix);
          if (lists[column].empty() || lists[column].back() != c) lists[column].push_back(c);
          columns_[column].top = std::max(columns_[column].top, center.z() + reach);
        }
    }
  }
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    columns_[i].first = std::uint32_t(cones_in_.size());
    columns_[i].cones = std::uint16_t(lists[i].size());
    cones_in_.insert(cones_in_.end(), lists[i].begin(), lists[i].end());
  }
}

void Scene::take_foliage(const Foliage& foliage) {
  layer_zero_ = float(foliage.bottom);
  layers_ = foliage.layers;
  leaves_ = foliage.extinction;
  for (std::size_t i = 0; i < columns_.size(); ++i)
    for (int layer = 0; layer < layers_; ++layer) {
      if (leaves_[i * std::size_t(layers_) + std::size_t(layer)] <= 0) continue;
      Column& c = columns_[i];
      if (c.leaf_end == 0) c.leaf_begin = std::uint16_t(layer);
      c.leaf_end = std::uint16_t(layer + 1);
    }
}

}  // namespace cambium::simulate
