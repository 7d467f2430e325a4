#include "simulator/model/sdformat_access.h"

#include <console_bridge/console.h>

#include <exception>
#include <mutex>

namespace plumbline::model {
namespace {

constexpr const char* kExpected = "a skeleton that libsdformat can read";

/// libsdformat and the URDF parser below it write to the console and keep global state.
std::mutex& quiet_sdformat() {
  static std::mutex mutex;
  static const bool silenced = [] {
    sdf::Console::Instance()->SetQuiet(true);
    console_bridge::noOutputHandler();
    return true;
  }();
  static_cast<void>(silenced);
  return mutex;
}

void load(SkeletonXml& xml, UrdfShapes shapes, const std::function<void(const LoadedSdf&)>& use) {
  sdf::Root root;
  refuse_errors(xml.is_urdf()        ? root.LoadSdfString(xml.urdf_for_sdformat(shapes))
                : xml.has_massless() ? root.LoadSdfString(xml.text())
                                     : root.Load(xml.file()),
                xml);
  const sdf::World* world = root.WorldCount() > 0 ? root.WorldByIndex(0) : nullptr;
  const sdf::Model* model = world != nullptr ? world->ModelByIndex(0) : root.Model();
  if (model == nullptr) {
    xml.refuse({"", 0}, "no model", "one model");
  }
  use({world, *model});
}

}  // namespace

void refuse_errors(const sdf::Errors& errors, const SkeletonXml& xml) {
  if (errors.empty()) {
    return;
  }
  const sdf::Error& first = errors.front();
  XmlPart part = xml.part_in(first.Message());
  if (part.line == 0 && !xml.is_urdf() && first.LineNumber()) {
    part.line = *first.LineNumber();
  }
  xml.refuse(part, first.Message(), kExpected);
}

Eigen::Vector3d to_eigen(const ignition::math::Vector3d& v) { return {v.X(), v.Y(), v.Z()}; }

Eigen::Isometry3d to_eigen(const ignition::math::Pose3d& pose) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  const ignition::math::Quaterniond& q = pose.Rot();
  X.linear() = Eigen::Quaterniond(q.W(), q.X(), q.Y(), q.Z()).normalized().toRotationMatrix();
  X.translation() = to_eigen(pose.Pos());
  return X;
}

Eigen::Matrix3d to_eigen(const ignition::math::Matrix3d& m) {
  Eigen::Matrix3d M;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      M(i, j) = m(static_cast<std::size_t>(i), static_cast<std::size_t>(j));
    }
  }
  return 0.5 * (M + M.transpose());
}

void with_sdformat(SkeletonXml& xml, UrdfShapes shapes, const std::function<void(const LoadedSdf&)>& use) {
  const std::lock_guard<std::mutex> lock(quiet_sdformat());
  try {
    load(xml, shapes, use);
  } catch (const InputError&) {
    throw;
  } catch (const sdf::Exception& error) {
    xml.refuse({"", 0}, error.GetErrorStr(), kExpected);
  } catch (const std::exception& error) {
    xml.refuse({"", 0}, error.what(), kExpected);
  }
}

}  // namespace plumbline::model
