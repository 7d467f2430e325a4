// Skeletons that are written back: against MuJoCo, where it is installed, which reads the file, and against
// our own plant of the file.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "simulator/model/known_effects.h"
#include "simulator/model/plant.h"
#include "simulator/model/robot_file.h"
#include "simulator/model/skeleton_export.h"
#include "simulator/model/xml_text.h"
#include "tests/trace/refusal.h"
#include "tests/trace/temporary_folder.h"

#ifdef PLUMBLINE_HAS_MUJOCO
#include <mujoco/mujoco.h>
#endif

namespace plumbline::model {
namespace {

using testing::HasSubstr;

constexpr const char* kMjcf = R"(<mujoco model="leg">
  <!-- A carriage on a rail; its leg has two joints. -->
  <compiler angle="degree" autolimits="true"/>
  <option gravity="0 0.5 -9.7"/>
  <default><joint damping="0.2"/><default class="knee"><joint frictionloss="0.3"/></default></default>
  <worldbody>
    <body name="carriage" pos="0.1 0 1.2" euler="10 20 30">
      <joint name="rail" type="slide" axis="1 0 0.2" damping="5"/>
      <inertial pos="0.01 0.02 0.03" quat="0.9 0.1 0.3 0.2" mass="3"   diaginertia="0.02 0.03 0.04"/>
      <body name="thigh" pos="0 0.1 0">
        <joint name="hip" axis="0 1 0"/>
        <geom type="capsule" fromto="0 0 0 0.1 0 -0.4" size="0.03"/> <!-- gives the inertia -->
        <body name="shin" pos="0.1 0 -0.4" childclass="knee">
          <joint name="knee" axis="0 1 0"/>
          <geom type="cylinder" size="0.02 0.2" pos="0 0 -0.2"/>
        </body>
      </body>
    </body>
  </worldbody>
</mujoco>
)";

constexpr const char* kUrdf = R"(<?xml version="1.0"?>
<robot name="leg">
  <!-- a rail without mass of its own -->
  <link name="base"/>
  <link name="sled"/>
  <link name="thigh">
    <inertial>
      <origin xyz="0.02 0 -0.2" rpy="0.3 0.2 0.1"/>
      <mass value='1.5'/>   <!-- weighed -->
      <inertia ixx="0.02" iyy="0.021" izz="0.003" ixy="0.001" ixz="0" iyz="0"/>
    </inertial>
  </link>
  <link name="shin">
    <inertial><mass value="0.8"/><inertia ixx="0.01" iyy="0.011" izz="0.002" ixy="0" ixz="0" iyz="0"/></inertial>
  </link>
  <joint name="rail" type="prismatic"><parent link="base"/><child link="sled"/><origin xyz="0 0 1" rpy="0 0.2 0"/>
    <axis xyz="1 0 0"/><limit lower="-1" upper="1" effort="9" velocity="9"/></joint>
  <joint name="hip" type="continuous">
    <parent link="sled"/><child link="thigh"/>
    <origin xyz="0.1 0.05 0" rpy="0 0 0.4"/>
    <axis xyz="0 1 0.2"/>
    <dynamics damping="0.2"/>
  </joint>
  <joint name="knee" type="continuous">
    <parent link="thigh"/><child link="shin"/>
    <origin xyz="0 0 -0.4" rpy="0.1 0 0"/>
    <axis xyz="0 1 0"/>
  </joint>
</robot>
)";

constexpr const char* kSdf = R"(<?xml version="1.0"?>
<sdf version="1.7">
  <world name="hall">
    <gravity>0 0 -9.7</gravity>
    <model name="leg">
      <link name="thigh">
        <inertial> <!-- from the drawing -->
          <pose>0.02 0 -0.2 0.3 0.2 0.1</pose>
          <mass>1.5</mass>
          <inertia><ixx>0.02</ixx><iyy>0.021</iyy><izz>0.003</izz></inertia>
        </inertial>
      </link>
      <link name="shin">
        <pose>0 0 -0.4 0.1 0 0</pose>
        <inertial><mass>0.8</mass><inertia><ixx>0.01</ixx><iyy>0.011</iyy><izz>0.002</izz></inertia></inertial>
      </link>
      <joint name="hip" type="revolute">
        <parent>world</parent><child>thigh</child>
        <axis><xyz>0 1 0.2</xyz><dynamics><friction>0.1</friction></dynamics></axis>
      </joint>
      <joint name="knee" type="revolute">
        <parent>thigh</parent><child>shin</child>
        <axis>
          <xyz>0 1 0</xyz>
        </axis>
      </joint>
    </model>
  </world>
</sdf>
)";

/// A drive at the knee, and everything that a simulator of rigid bodies can be told. The hip's motor turns 3
/// times against it.
std::string model_text(const std::string& skeleton, bool rail) {
  return std::string("plumbline: model/1\nrobot: leg\nskeleton: ") + skeleton + "\ncoordinates: {" +
         (rail ? "rail: {of: {rail: 1}}, " : "") + R"(hip: {of: {hip: 1}}, shank: {of: {knee: -1}}}
motors:
  m_hip: {command_unit: N m, rotor_inertia: {value: 0.002, unit: kg m^2, source: sheet}}
  m_knee: {command_unit: A, rotor_inertia: {value: 1e-4, unit: kg m^2, source: sheet}, torque_constant: {value: 0.1, unit: N m/A, source: sheet}}
ratios:
  hip: {motor: m_hip, ratio: {value: -3, unit: 1, source: sheet}}
  shank: {motor: m_knee, ratio: {value: 20, unit: 1, source: sheet}}
effects:
  - {effect: added_mass, at: thigh, values: {mass: {value: 0.4, unit: kg, source: fit}}}
  - {effect: com_shift, at: thigh, values: {x: {value: 0.02, unit: m, source: fit}, z: {value: -0.03, unit: m, source: fit}}}
  - {effect: payload, at: shin, values: {mass: {value: 0.6, unit: kg, source: fit}, x: {value: 0.05, unit: m, source: fit}, y: {value: 0.02, unit: m, source: fit}, z: {value: -0.3, unit: m, source: fit}}}
  - {effect: viscous, at: hip, values: {damping: {value: 0.31, unit: N m s/rad, source: fit}}}
  - {effect: viscous, at: m_knee, values: {damping: {value: 0.002, unit: N m s/rad, source: fit}}}
  - {effect: rotor_inertia, at: m_knee, values: {inertia: {value: 5e-5, unit: kg m^2, source: fit}}}
  - {effect: spring, at: hip, values: {stiffness: {value: 0, unit: N m/rad, source: fit}}}
  - {effect: command_delay, at: m_knee, values: {delay: {value: 0.002, unit: s, source: fit}}}
)";
}

class Export : public testing::Test {
 protected:
  Model model_of(const std::string& skeleton, const char* text, bool rail = true) {
    folder_.write(skeleton, text);
    return read_model(folder_.write("model.yaml", model_text(skeleton, rail)), known_effects());
  }
  SkeletonExport export_to(const Model& model, const std::string& name) {
    return export_skeleton(model, folder_.path(name));
  }

  /// The file's own plant, its damping and friction taken; the rotors, which only MJCF can say, in the model.
  Model plain_model(const std::string& skeleton, bool rail, bool rotors) {
    std::string text = "plumbline: model/1\nrobot: leg\nskeleton: " + skeleton + "\ncoordinates: {" +
                       (rail ? "rail: {of: {rail: 1}}, " : "") +
                       "hip: {of: {hip: 1}}, knee: {of: {knee: 1}}}\njoint_dynamics: take\n";
    if (rotors) {
      text +=
          "inertias:\n  a: {at: hip, value: {value: 0.018, unit: kg m^2, source: \"9 x 0.002\"}}\n"
          "  b: {at: knee, value: {value: 0.06, unit: kg m^2, source: \"400 x 1.5e-4\"}}\n";
    }
    return read_model(folder_.write("plain.yaml", text), known_effects());
  }

  static Eigen::VectorXd rate(const Model& model, const Eigen::VectorXd& z, const Eigen::VectorXd& v) {
    Plant plant(model, {});
    EXPECT_EQ(plant.positions(), z.size());
    Eigen::VectorXd x = Eigen::VectorXd::Zero(plant.states());
    x.head(z.size()) = z;
    x.segment(z.size(), z.size()) = v;
    Eigen::VectorXd result(plant.states());
    const Eigen::VectorXd none = Eigen::VectorXd::Zero(plant.motors());
    plant.rate(x.data(), none.data(), result.data());
    return result.segment(z.size(), z.size());
  }

  static void expect_same_accelerations(const Model& a, const Model& b, Eigen::Index positions) {
    std::srand(5);
    for (int state = 0; state < 10; ++state) {
      const Eigen::VectorXd z = Eigen::VectorXd::Random(positions);
      const Eigen::VectorXd v = Eigen::VectorXd::Random(positions);
      const Eigen::VectorXd expected = rate(a, z, v);
      EXPECT_LT((rate(b, z, v) - expected).norm(), 1e-9 * expected.norm()) << "state " << state;
    }
  }

  test::TemporaryFolder folder_;
};

TEST_F(Export, UrdfMovesAsTheModelDoes) {
  const Model model = model_of("leg.urdf", kUrdf);
  const SkeletonExport made = export_to(model, "out.urdf");
  EXPECT_EQ(made.format, "URDF");
  expect_same_accelerations(model, plain_model("out.urdf", true, true), 3);
  EXPECT_THAT(made.left_out, testing::Contains(HasSubstr("Joint knee: its armature of 0.06 kg m^2")));
  EXPECT_THAT(made.left_out, testing::Contains(HasSubstr("command_delay at m_knee")));
  EXPECT_THAT(made.left_out, testing::Contains(HasSubstr("Motor m_knee: -2 N m at joint knee for each A")));
  EXPECT_THAT(made.left_out, testing::Not(testing::Contains(HasSubstr("spring"))));  // at its null value
}

TEST_F(Export, SdfMovesAsTheModelDoes) {
  const Model model = model_of("leg.sdf", kSdf, false);
  export_to(model, "out.sdf");
  // The model takes nothing over of the file's friction, and so the file must not state it any longer.
  EXPECT_THAT(folder_.read("out.sdf"), HasSubstr("<friction>0</friction>"));
  expect_same_accelerations(model, plain_model("out.sdf", false, true), 2);
}

TEST_F(Export, MjcfMovesAsTheModelDoes) {
  const Model model = model_of("leg.xml", kMjcf);
  export_to(model, "out.xml");
  expect_same_accelerations(model, plain_model("out.xml", true, false), 3);
}

TEST_F(Export, UrdfBecomesMjcf) {
  const Model model = model_of("leg.urdf", kUrdf);
  const SkeletonExport made = export_to(model, "out.xml");
  EXPECT_EQ(made.format, "MJCF");
  expect_same_accelerations(model, plain_model("out.xml", true, false), 3);
}

/// Lines that only one of two texts has.
std::vector<std::string> new_lines(const std::string& before, const std::string& after) {
  std::vector<std::string> lines;
  std::istringstream text(after);
  for (std::string line; std::getline(text, line);) {
    if (before.find(line + "\n") == std::string::npos) {
      lines.push_back(line);
    }
  }
  return lines;
}

TEST_F(Export, KeepsEveryOtherByte) {
  export_to(model_of("leg.urdf", kUrdf), "out.urdf");
  EXPECT_THAT(new_lines(kUrdf, folder_.read("out.urdf")),
              testing::ElementsAre("      <origin xyz=\"0.04 0 -0.23\" rpy=\"0 0 0\"/>",
                                   "      <mass value='1.9'/>   <!-- weighed -->", HasSubstr("<inertia ixx="),
                                   HasSubstr("<inertial><origin xyz="),
                                   "    <dynamics damping=\"0.31\" friction=\"0\"/>",
                                   "    <dynamics damping=\"0.8\" friction=\"0\"/>"));
  export_to(model_of("leg.xml", kMjcf), "out.xml");
  const std::string out = folder_.read("out.xml");
  EXPECT_THAT(
      out,
      HasSubstr("      <inertial pos=\"0.01 0.02 0.03\" quat=\"0.9 0.1 0.3 0.2\" mass=\"3\"   diaginertia="));
  EXPECT_THAT(out, HasSubstr("<!-- gives the inertia -->"));
  EXPECT_THAT(out, HasSubstr("type=\"slide\" axis=\"1 0 0.2\" damping=\"0\"/>"));
}

TEST_F(Export, OfAModelThatChangesNothingIsTheSameFile) {
  folder_.write("leg.urdf", kUrdf);
  const Model model = plain_model("leg.urdf", true, false);
  EXPECT_TRUE(export_to(model, "out.urdf").changed.empty());
  EXPECT_EQ(folder_.read("out.urdf"), kUrdf);
}

TEST_F(Export, WhatCannotBeIsRefusedInOneLineAndLeavesNothing) {
  const Model model = model_of("leg.urdf", kUrdf);
  const std::size_t files = folder_.file_count();
  EXPECT_THAT(test::refusal([&] { export_to(model, "out.sdf"); }),
              HasSubstr("out.sdf: found SDFormat wished of a skeleton in URDF"));
  EXPECT_THAT(test::refusal([&] { export_to(model, "out.txt"); }),
              HasSubstr("expected one that ends in .urdf"));
  EXPECT_EQ(folder_.file_count(), files);
}

TEST(XmlText, EditsWhereCommentsAndCdataLookLikeElements) {
  XmlText xml("a.xml",
              "<?xml version='1'?><!-- <a b='1'> --><a  b = '1' ><![CDATA[<c>]]><c/>\n  <d>5</d></a>\n");
  xml.set_attribute(xml.root(), "b", "2");
  xml.set_content(*xml.root().child("c"), "7");
  xml.set_content(*xml.root().child("d"), "6");
  xml.insert(xml.root(), {"<e/>"}, XmlText::Where::last);
  EXPECT_EQ(
      xml.edited(),
      "<?xml version='1'?><!-- <a b='1'> --><a  b = '2' ><![CDATA[<c>]]><c>7</c>\n  <d>6</d>\n  <e/></a>\n");
}

#ifdef PLUMBLINE_HAS_MUJOCO
/// MuJoCo integrates the exported file, the plant of the model is held against its accelerations on the way.
class InMujoco : public Export, public testing::WithParamInterface<bool> {};

TEST_P(InMujoco, AcceleratesAsTheModelDoes) {
  const Model model = GetParam() ? model_of("leg.urdf", kUrdf) : model_of("leg.xml", kMjcf);
  export_to(model, "out.xml");
  char error[500] = "";
  mjModel* m = mj_loadXML(folder_.path("out.xml").c_str(), nullptr, error, sizeof error);
  ASSERT_NE(m, nullptr) << error;
  ASSERT_EQ(m->nv, 3);
  m->opt.disableflags |= mjDSBL_CONTACT | mjDSBL_LIMIT | mjDSBL_EQUALITY;
  m->opt.timestep = 1e-3;
  m->opt.integrator = mjINT_RK4;
  mjData* d = mj_makeData(m);
  const Eigen::Vector3d start(0.1, 0.6, -0.8);
  Eigen::Map<Eigen::Vector3d>(d->qpos) = start;
  for (int step = 0; step < 1000; ++step) {
    if (step % 50 == 0) {
      mj_forward(m, d);
      const Eigen::Vector3d theirs = Eigen::Map<Eigen::Vector3d>(d->qacc);
      const Eigen::VectorXd ours =
          rate(model, Eigen::Map<Eigen::Vector3d>(d->qpos), Eigen::Map<Eigen::Vector3d>(d->qvel));
      // MuJoCo looks for the principal axes of an inertia by an iteration that ends at about 1e-8 of it.
      EXPECT_LT((ours - theirs).norm(), 1e-7 * (1.0 + theirs.norm())) << "step " << step;
    }
    mj_step(m, d);
  }
  EXPECT_GT((Eigen::Map<Eigen::Vector3d>(d->qpos) - start).norm(), 0.1) << "it moves";
  mj_deleteData(d);
  mj_deleteModel(m);
}

INSTANTIATE_TEST_SUITE_P(Formats, InMujoco, testing::Bool());
#endif

}  // namespace
}  // namespace plumbline::model
