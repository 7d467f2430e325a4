// Good meshes in four formats, and everything that can be wrong with one.
#include "simulator/mesh/mesh_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "simulator/mesh/mesh_mass.h"
#include "tests/trace/temporary_folder.h"

namespace plumbline::mesh {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

const Eigen::Vector3d kMetres = Eigen::Vector3d::Ones();

// A tetrahedron of volume a b c / 6 with its right-angled corner at the origin: edges 0.3, 0.2, 0.1 m.
constexpr double kVolume = 0.3 * 0.2 * 0.1 / 6.0;
const char* const kObj = "v 0 0 0\nv 0.3 0 0\nv 0 0.2 0\nv 0 0 0.1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
const char* const kStl =
    "solid t\n"
    "facet normal 0 0 -1\nouter loop\nvertex 0 0 0\nvertex 0 0.2 0\nvertex 0.3 0 0\nendloop\nendfacet\n"
    "facet normal 0 -1 0\nouter loop\nvertex 0 0 0\nvertex 0.3 0 0\nvertex 0 0 0.1\nendloop\nendfacet\n"
    "facet normal 1 1 1\nouter loop\nvertex 0.3 0 0\nvertex 0 0.2 0\nvertex 0 0 0.1\nendloop\nendfacet\n"
    "facet normal -1 0 0\nouter loop\nvertex 0 0 0\nvertex 0 0 0.1\nvertex 0 0.2 0\nendloop\nendfacet\n"
    "endsolid t\n";
const char* const kDae = R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
  <asset><unit name="meter" meter="1"/><up_axis>Z_UP</up_axis></asset>
  <library_geometries><geometry id="t"><mesh>
    <source id="p"><float_array id="pa" count="12">0 0 0 0.3 0 0 0 0.2 0 0 0 0.1</float_array>
      <technique_common><accessor source="#pa" count="4" stride="3">
        <param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/>
      </accessor></technique_common></source>
    <vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
    <triangles count="4"><input semantic="VERTEX" source="#v" offset="0"/>
      <p>0 2 1 0 1 3 1 2 3 0 3 2</p></triangles>
  </mesh></geometry></library_geometries>
  <library_visual_scenes><visual_scene id="s"><node id="n"><instance_geometry url="#t"/></node>
  </visual_scene></library_visual_scenes>
  <scene><instance_visual_scene url="#s"/></scene>
</COLLADA>
)";
// Twelve little-endian floats and twelve 16-bit indices, base64.
const char* const kGltf = R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],
"buffers":[{"byteLength":72,"uri":"data:application/octet-stream;base64,)"
                          "AAAAAAAAAAAAAAAAmpmZPgAAAAAAAAAAAAAAAM3MTD4AAAAAAAAAAAAAAADNzMw9"
                          "AAACAAEAAAABAAMAAQACAAMAAAADAAIA"
                          R"("}],
"bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":24}],
"accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[0,0,0],"max":[0.3,0.2,0.1]},
{"bufferView":1,"componentType":5123,"count":12,"type":"SCALAR"}]})";

class MeshFileTest : public testing::Test {
 protected:
  MeshFile read(const std::string& name, const std::string& text,
                const Eigen::Vector3d& scale = kMetres) const {
    return read_mesh(folder_.write(name, text), scale);
  }
  std::string problem(const std::string& text) const { return read("bad.obj", text).problem; }

  test::TemporaryFolder folder_;
};

TEST_F(MeshFileTest, ReadsObjStlDaeAndGltfAlike) {
  for (const auto& [name, text] : {std::pair("t.obj", kObj), std::pair("t.stl", kStl),
                                   std::pair("t.dae", kDae), std::pair("t.gltf", kGltf)}) {
    const MeshFile file = read(name, text);
    ASSERT_EQ(file.problem, "") << name;
    EXPECT_EQ(file.mesh.points.size(), 4U) << name;
    EXPECT_TRUE(is_closed(file.mesh)) << name;
    const SolidProperties solid = solid_properties(file.mesh);
    EXPECT_NEAR(solid.volume, kVolume, 1e-9) << name;  // the formats hold single precision
    EXPECT_LT((solid.center - Eigen::Vector3d(0.075, 0.05, 0.025)).norm(), 1e-7) << name;
  }
}

TEST_F(MeshFileTest, ScaleWorksAxisByAxisAndAMirrorKeepsTheOutsideOut) {
  const MeshFile file = read("t.obj", kObj, {2.0, -1.0, 0.5});
  ASSERT_EQ(file.problem, "");
  EXPECT_TRUE(is_closed(file.mesh));
  double signed_volume = 0.0;
  for (const auto& [a, b, c] : file.mesh.triangles) {
    const auto at = [&](int i) { return file.mesh.points[static_cast<std::size_t>(i)]; };
    signed_volume += at(a).dot(at(b).cross(at(c))) / 6.0;
  }
  EXPECT_NEAR(signed_volume, kVolume, 1e-9);
}

TEST_F(MeshFileTest, EveryProblemIsOneLineWithTheFile) {
  const MeshFile missing = read_mesh(folder_.path("none.stl"), kMetres);
  EXPECT_EQ(missing.problem, folder_.path("none.stl") + ": mesh: found no such file, expected a mesh");
  EXPECT_THAT(problem("this is no mesh\n"), StartsWith(folder_.path("bad.obj") + ": mesh: found "));
  EXPECT_THAT(problem(""), HasSubstr("nothing that can be read"));
  EXPECT_THAT(problem("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n"), HasSubstr("no triangle with an area"));
  EXPECT_THAT(problem("v 0 0 0\nv 300 0 0\nv 0 200 0\nf 1 2 3\n"),
              HasSubstr("a size of 361 m across, expected metres (a <scale> of 0.001"));
  EXPECT_THAT(problem("v 0 0 0\nv 6e-5 0 0\nv 0 6e-5 0\nf 1 2 3\n"), HasSubstr("m across, expected metres"));
  EXPECT_THAT(problem("v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n"), HasSubstr("expected"));
  for (const std::string& text : {problem("rubbish"), problem("")}) {
    EXPECT_EQ(text.find('\n'), std::string::npos) << text;
  }
}

TEST_F(MeshFileTest, MillimetresWithTheirScaleAreGood) {
  const MeshFile file = read("t.obj", "v 0 0 0\nv 300 0 0\nv 0 200 0\nf 1 2 3\n", 1e-3 * kMetres);
  EXPECT_EQ(file.problem, "");
  EXPECT_NEAR(file.mesh.points[1].norm() + file.mesh.points[2].norm() + file.mesh.points[0].norm(), 0.5,
              1e-6);
}

}  // namespace
}  // namespace plumbline::mesh
