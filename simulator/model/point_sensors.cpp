#include "simulator/model/point_sensors.h"

#include "simulator/model/rotation_vector.h"

namespace plumbline::model {

Eigen::Vector3d point_reading(const TreeDynamics& tree, int body, const Sensor& sensor,
                              const Eigen::VectorXd& acceleration) {
  const Eigen::Vector3d p = tree.station(body, sensor.point);
  const Eigen::Matrix3d R_WS = tree.rotation(body) * sensor.mounting;
  switch (sensor.reading) {
    case PointReading::marker:
      return p;
    case PointReading::orientation:
      return rotation_vector(R_WS);
    case PointReading::gyroscope:
      return R_WS.transpose() * tree.angular_velocity(body);
    case PointReading::accelerometer:
      return R_WS.transpose() * (tree.station_acceleration(body, p) +
                                 tree.station_jacobian(body, p) * acceleration - tree.gravity());
    case PointReading::none:
      break;
  }
  return Eigen::Vector3d::Zero();
}

Eigen::Matrix3Xd point_rows(const TreeDynamics& tree, int body, const Sensor& sensor) {
  const Eigen::Vector3d p = tree.station(body, sensor.point);
  if (sensor.reading == PointReading::marker) {
    return tree.station_jacobian(body, p);
  }
  const Eigen::Matrix3d R_SW = (tree.rotation(body) * sensor.mounting).transpose();
  return R_SW * (sensor.reading == PointReading::accelerometer ? tree.station_jacobian(body, p)
                                                               : tree.turn_jacobian(body));
}

}  // namespace plumbline::model
