// SPDX-License-Identifier: BSD-3-Clause
// A cloud made ready for registration: thinned, with a normal per point and a search tree.
#pragma once
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>

#include <memory>

#include "cambium/payload.hpp"

namespace cambium::registration {

using Point = pcl::PointNormal;
using Points = pcl::PointCloud<Point>;
using Tree = pcl::search::KdTree<Point>;

/// Read-only once made; PCL wants pointers to mutable objects but does not write through them when
/// it is told not to build its own tree.
struct Surface {
  Points::Ptr points;  ///< base frame [m]; unit normals, turned towards the origin
  Tree::Ptr tree;      ///< over `points`; null when there are none
  std::size_t size() const { return points->size(); }
  std::size_t bytes() const;
};

/// One point per occupied cell of `voxel_size` [m]: the mean of the cell's points. Points that are
/// not finite are left out: drivers write them for "no return". Ordered by cell, so the result does
/// not depend on the order of the cloud beyond rounding.
Points::Ptr thin(const Cloud& cloud, double voxel_size);

/// Every k-th point, k the smallest number that leaves at most `limit`: `points` are ordered by
/// cell, so this thins evenly.
Points::Ptr sample(const Points& points, std::size_t limit);

/// `points` with the normal of the plane through each one's `neighbours` nearest points.
Surface make_surface(Points::Ptr points, int neighbours);

}  // namespace cambium::registration
