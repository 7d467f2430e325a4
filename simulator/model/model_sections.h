// The sections of a model.yaml, each read into its part of the Model. Every function throws InputError.
#pragma once

#include <array>
#include <string>

#include "simulator/model/model.h"
#include "simulator/model/yaml_node.h"

namespace plumbline::model {

/// gravity: magnitude, along the skeleton's own direction (downwards when that has none).
void read_gravity(const YamlNode& node, Model& model);
/// masses: uncertainty of the skeleton's masses.
void read_masses(const YamlNode& node, Model& model);
/// coordinates: sums of joints and pulleys, all rotary or all linear; needs pulleys.
void read_coordinates(const YamlNode& node, Model& model);
void read_motors(const YamlNode& node, Model& model);
void read_pulleys(const YamlNode& node, Model& model);
/// ratios: needs coordinates, motors and pulleys.
void read_ratios(const YamlNode& node, Model& model);
void read_inertias(const YamlNode& node, Model& model);
/// feet: points of links that may meet the ground.
void read_feet(const YamlNode& node, Model& model);
/// contacts: pairs of links that may meet each other; needs feet, whose names are taken.
void read_contacts(const YamlNode& node, Model& model);
/// A sphere, and the two ends of a capsule, of an MJCF skeleton that may touch something, by the geom's name.
const ContactSphere& skeleton_sphere(const YamlNode& name, const Model& model);
std::array<ContactSphere, 2> skeleton_capsule(const YamlNode& name, const Model& model);
/// The `link` of a map: its index in the skeleton's bodies, or -1 for the world.
int link_or_world(const YamlNode& node, const Model& model);
/// loops: what closes chains of joints, and where they are closed first.
void read_loops(const YamlNode& node, Model& model);
/// sensors: of positions, force plates, contact switches, and what is measured at points of links; needs
/// feet.
void read_sensors(const YamlNode& node, Model& model);
/// Does an entry of sensors state a marker, orientation, gyroscope or accelerometer? And its three
/// components.
bool is_point_sensor(const YamlNode& entry);
void read_point_sensor(const std::string& name, const YamlNode& entry, Model& model);

/// One name means one thing among joints, coordinates, motors and pulleys; a coordinate may share the name of
/// the joint that it is. `root` gives the line.
void check_names(const YamlNode& root, const Model& model);

/// Refuses ratios that repeat each other, or that together hold a joint or motor still.
void check_ratios(const YamlNode& root, const Model& model);

}  // namespace plumbline::model
