// Volume, centre and inertia of closed meshes against closed forms.
#include "simulator/mesh/mesh_mass.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "tests/mesh/shapes.h"

namespace plumbline::mesh {
namespace {

// Rounding of sums over at most 10^5 triangles.
constexpr double kRounding = 1e-12;

TEST(MeshMass, BoxAsTheTextbookHasIt) {
  const Eigen::Vector3d low(0.4, -1.0, 2.0);
  const Eigen::Vector3d size(0.2, 0.5, 1.1);
  const SolidProperties solid = solid_properties(box_mesh(low, low + size));
  const double volume = size.prod();
  EXPECT_NEAR(solid.volume, volume, kRounding);
  EXPECT_LT((solid.center - (low + 0.5 * size)).norm(), kRounding);
  // I_x = m (b^2 + c^2) / 12
  const Eigen::Vector3d squares = size.cwiseAbs2();
  const Eigen::Vector3d expected = volume / 12.0 * (Eigen::Vector3d::Constant(squares.sum()) - squares);
  EXPECT_LT((solid.inertia - Eigen::Matrix3d(expected.asDiagonal())).norm(), kRounding);
}

// F. Tonon, J. Mathematics and Statistics 1 (2005), section 4: the worked example, printed to five digits.
// (His products of inertia b', c' carry the other sign and the axes of his equation 1.)
TEST(MeshMass, TetrahedronOfTononsExample) {
  const std::array<Eigen::Vector3d, 4> corners{
      Eigen::Vector3d(8.33220, -11.86875, 0.93355), Eigen::Vector3d(0.75523, 5.00000, 16.37072),
      Eigen::Vector3d(52.61236, 5.00000, -5.38580), Eigen::Vector3d(2.00000, 5.00000, 3.00000)};
  const SolidProperties solid = solid_properties(tetrahedron_mesh(corners));
  EXPECT_LT((solid.center - Eigen::Vector3d(15.92492, 0.78281, 3.72962)).norm(), 5e-5);
  EXPECT_NEAR(solid.inertia(0, 0) / 43520.33257, 1.0, 1e-6);
  EXPECT_NEAR(solid.inertia(1, 1) / 194711.28938, 1.0, 1e-6);
  EXPECT_NEAR(solid.inertia(2, 2) / 191168.76173, 1.0, 1e-6);
  EXPECT_NEAR(std::abs(solid.inertia(1, 2)) / 4417.66150, 1.0, 1e-6);
  EXPECT_NEAR(std::abs(solid.inertia(0, 2)) / 46343.16662, 1.0, 1e-6);
  EXPECT_NEAR(std::abs(solid.inertia(0, 1)) / 11996.20119, 1.0, 1e-6);
}

// A surface with corners on the sphere misses it by O(h^2): four times less with every division.
TEST(MeshMass, SphereIsApproachedInSecondOrder) {
  const double radius = 0.3;
  const double volume = 4.0 / 3.0 * M_PI * std::pow(radius, 3);
  double before = 0.0;
  for (int times = 3; times <= 5; ++times) {
    const SolidProperties solid = solid_properties(sphere_mesh(radius, times));
    const double missing = 1.0 - solid.volume / volume;
    const double inertia = 0.4 * solid.volume * radius * radius;  // 2/5 m r^2
    EXPECT_NEAR(solid.inertia(0, 0) / inertia, 1.0, missing);
    EXPECT_LT(solid.center.norm(), 1e-12);
    if (times > 3) {
      EXPECT_NEAR(before / missing, 4.0, 0.1);
    }
    before = missing;
  }
  EXPECT_LT(before, 2e-3);
}

// Steiner: what is shifted far away keeps its central inertia; what is turned inside out is the same solid.
TEST(MeshMass, NeitherPlaceNorSenseMatters) {
  Mesh mesh = box_mesh({0, 0, 0}, {0.3, 0.2, 0.1});
  const SolidProperties here = solid_properties(mesh);
  for (Eigen::Vector3d& point : mesh.points) {
    point += Eigen::Vector3d(1000.0, -500.0, 200.0);
  }
  for (auto& triangle : mesh.triangles) {
    std::swap(triangle[0], triangle[1]);
  }
  const SolidProperties there = solid_properties(mesh);
  EXPECT_NEAR(there.volume, here.volume, 1e-12);
  EXPECT_LT((there.inertia - here.inertia).norm() / here.inertia.norm(), 1e-9);
}

TEST(MeshMass, AHoleAndATurnedTriangleOpenTheSurface) {
  Mesh mesh = box_mesh({0, 0, 0}, {1, 1, 1});
  EXPECT_TRUE(is_closed(mesh));
  Mesh turned = mesh;
  std::swap(turned.triangles[3][0], turned.triangles[3][1]);
  EXPECT_FALSE(is_closed(turned));
  mesh.triangles.pop_back();
  EXPECT_FALSE(is_closed(mesh));
  EXPECT_FALSE(is_closed(Mesh()));
}

}  // namespace
}  // namespace plumbline::mesh
