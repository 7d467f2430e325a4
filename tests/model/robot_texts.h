// A small robot for the reader's tests: a slider that carries a two-link arm, one motor on each joint kind.
#pragma once

#include <string>

namespace plumbline::test {

inline const std::string kSkeleton = R"(<?xml version="1.0"?>
<sdf version="1.9">
  <model name="arm">
    <link name="cart">
      <inertial>
        <mass>4</mass>
        <inertia><ixx>0.1</ixx><iyy>0.1</iyy><izz>0.1</izz></inertia>
      </inertial>
    </link>
    <link name="upper">
      <inertial>
        <pose>0 0 -0.25 0 0 0</pose>
        <mass>2</mass>
        <inertia><ixx>0.04</ixx><iyy>0.04</iyy><izz>0.01</izz></inertia>
      </inertial>
    </link>
    <link name="lower">
      <pose relative_to="upper">0 0 -0.5 0 0 0</pose>
      <inertial>
        <pose>0 0 -0.2 0 0 0</pose>
        <mass>1</mass>
        <inertia><ixx>0.02</ixx><iyy>0.02</iyy><izz>0.005</izz></inertia>
      </inertial>
    </link>
    <joint name="rail" type="prismatic">
      <parent>world</parent>
      <child>cart</child>
      <axis><xyz>1 0 0</xyz></axis>
    </joint>
    <joint name="shoulder" type="revolute">
      <parent>cart</parent>
      <child>upper</child>
      <axis><xyz>0 1 0</xyz></axis>
    </joint>
    <joint name="elbow" type="revolute">
      <parent>upper</parent>
      <child>lower</child>
      <axis><xyz>0 1 0</xyz></axis>
    </joint>
  </model>
</sdf>
)";

inline const std::string kModel = R"(plumbline: model/1
robot: test arm
skeleton: arm.sdf
gravity: {value: 9.81, unit: m/s^2, assumed: "a round number"}
masses:
  upper: {uncertainty: 2 %, source: "Table 1"}
  lower: {uncertainty: 0.05, assumed: "a guess"}
coordinates:
  rail: {of: {rail: 1}}
  shoulder: {of: {shoulder: 1}}
  tip: {of: {shoulder: 1, elbow: 0.5}, source: "equation 1"}
motors:
  mRail:
    command_unit: V
    rotor_inertia: {value: 20, unit: g cm^2, uncertainty: 5 %, source: "Table 2"}
    torque_constant: {value: 30, unit: mN m/V, uncertainty: 1, source: "Table 2", factory: 33}
    torque_limit: {value: 2, unit: N m, assumed: "fuse"}
  mTip:
    command_unit: N m
    rotor_inertia: {value: 1e-4, unit: kg m^2, source: "Table 2"}
ratios:
  rail:
    motor: mRail
    ratio: {value: 0.1, unit: rad/mm, source: "drawing"}
  tip:
    motor: mTip
    ratio: {value: -20, unit: "1", source: "drawing"}
    also:
      shoulder: {value: 3, unit: "1", source: "drawing"}
inertias:
  pulley:
    at: mTip
    value: {value: 2e-5, unit: kg m^2, source: "drawing"}
effects:
  - effect: drag
    at: mTip
    values:
      damping: {value: 0.3, unit: N m s/rad, uncertainty: 20 %, source: "Table 3"}
  - effect: stop
    at: rail
    values:
      position: {value: 300, unit: mm, source: "drawing"}
  - effect: stop
    at: rail
    values:
      side: {value: 1, unit: "1", source: "drawing"}
      stiffness: {value: 5, unit: kN/m, source: "Table 3"}
  - {effect: stretch, at: tip}
sensors:
  qTip:
    measures: mTip
    counts_per_turn: 2048
    gear: 2
    noise: {value: 0.1, unit: deg, source: "data sheet"}
    source: "data sheet"
  qRail:
    measures: rail
    resolution: {value: 1, unit: um, source: "data sheet"}
    offset: {value: 2, unit: mm, source: "data sheet"}
)";

/// The same skeleton with pulleys, one of them tied.
inline const std::string kPulleyModel = R"(plumbline: model/1
robot: r
skeleton: arm.sdf
pulleys:
  drum: {inertia: {value: 20, unit: g cm^2, uncertainty: 5 %, source: s}}
  idler: {inertia: {value: 1e-4, unit: kg m^2, source: s}}
coordinates:
  shoulder: {of: {shoulder: 1}}
  sum: {of: {elbow: 1, drum: 0.5}}
motors:
  mTip:
    command_unit: N m
    rotor_inertia: {value: 1e-4, unit: kg m^2, source: s}
ratios:
  shoulder:
    motor: mTip
    ratio: {value: 10, unit: "1", source: s}
    also: {drum: {value: -3, unit: "1", source: s}}
  idler: {pulley: idler, of: {drum: {value: 2, unit: "1", source: s}, sum: {value: 1, unit: "1", source: s}}}
inertias:
  rim: {at: drum, value: {value: 1e-5, unit: kg m^2, source: s}}
effects:
  - {effect: drag, at: drum, values: {damping: {value: 0.3, unit: N m s/rad, source: s}}}
sensors:
  drum: {measures: drum, counts_per_turn: 2048, source: s}
)";

inline const std::string kOverlay = R"(plumbline: model/1
base: model.yaml
note: "added by a test"
effects:
  - effect: payload
    at: lower
    values:
      mass: {value: 500, unit: g, uncertainty: 5 %, assumed: "a start"}
  - {effect: stretch, at: rail, values: {stiffness: {value: .inf, unit: N m/rad, source: "rigid"}}}
values:
  drag@mTip:damping: {value: 0.2, unit: N m s/rad, uncertainty: 0.01, source: "fit"}
  "stop@rail#2:stiffness": {value: 7, unit: N/mm, source: "fit"}
)";

/// An arm with turned joint and inertial frames, massless base and tool.
inline const std::string kUrdf = R"(<?xml version="1.0"?>
<robot name="arm">
  <link name="base"/>
  <link name="arm">
    <inertial>
      <origin xyz="0.1 0 0" rpy="0 0 0.5"/><mass value="2"/>
      <inertia ixx="0.1" iyy="0.2" izz="0.25" ixy="0" ixz="0" iyz="0"/>
    </inertial>
    <visual><geometry><mesh filename="none.stl"/></geometry></visual>
  </link>
  <link name="load">
    <inertial><mass value="3"/><inertia ixx="0.1" iyy="0.2" izz="0.25" ixy="0" ixz="0" iyz="0"/></inertial>
  </link>
  <link name="tool"/>
  <joint name="turn" type="continuous">
    <origin xyz="0 0 1" rpy="0.3 0 0"/><parent link="base"/><child link="arm"/><axis xyz="0 2 0"/>
  </joint>
  <joint name="weld" type="fixed"><origin xyz="0.2 0 0"/><parent link="arm"/><child link="load"/></joint>
  <joint name="flange" type="fixed"><origin xyz="0 0 0.1"/><parent link="load"/><child link="tool"/></joint>
</robot>
)";

inline const std::string kCsv = R"(t [s],q mLA [rad], u [N m]
0,0.1,-2.5e-3
0.001,"0.2",+3
0.002,.3,0
0.003,0.4,1e2
)";

}  // namespace plumbline::test
