// SPDX-License-Identifier: Apache-2.0
#include "adapters/gazebo_common/window_markers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

#include "adapters/gazebo_common/gz_names.h"

namespace tagfield {
namespace {

constexpr Duration kInterval = std::chrono::milliseconds(500);
constexpr const char* kService = "/marker";
constexpr const char* kTags = "tagfield_tags";
constexpr const char* kAntennas = "tagfield_antennas";
/// Appearance of a marker: Gazebo 11 only supports its own materials, later versions only colours.
struct Look {
  const char* material;
  ReadColor color;
};
/// From the weakest reads to the strongest, then for silent tags. A marker has a single look, so
/// tags are drawn in one marker per shade.
constexpr std::array<Look, 6> kShades = {{{"Gazebo/BlueTransparent", {0.0, 0.0, 1.0, 0.5}},
                                          {"Gazebo/GreenTransparent", {0.0, 1.0, 0.0, 0.5}},
                                          {"Gazebo/Green", {0.0, 1.0, 0.0, 1.0}},
                                          {"Gazebo/Orange", {1.0, 0.5, 0.0, 1.0}},
                                          {"Gazebo/Red", {1.0, 0.0, 0.0, 1.0}},
                                          {"Gazebo/GreyTransparent", {0.5, 0.5, 0.5, 0.5}}}};
constexpr int kSilent = static_cast<int>(kShades.size()) - 1;
constexpr Look kArrow = {"Gazebo/Orange", {1.0, 0.5, 0.0, 1.0}};
constexpr Look kBall = {"Gazebo/YellowTransparent", {1.0, 1.0, 0.0, 0.15}};
constexpr double kTagRadius = 0.06;  // [m] larger than a label, to be visible across a hall
constexpr double kArrowLength = 0.5;
constexpr double kArrowRadius = 0.04;

using gz_msgs::Marker;

gz_math::Vector3d to_gz(const Eigen::Vector3d& p) { return {p.x(), p.y(), p.z()}; }

void set_color(const ReadColor& color, gz_msgs::Color& to) {
  to.set_r(static_cast<float>(color.red));
  to.set_g(static_cast<float>(color.green));
  to.set_b(static_cast<float>(color.blue));
  to.set_a(static_cast<float>(color.alpha));
}

void set_look(const Look& look, Marker& marker) {
  gz_msgs::Material& material = *marker.mutable_material();
  material.mutable_script()->set_name(look.material);
  material.mutable_script()->add_uri("file://media/materials/scripts/gazebo.material");
  set_color(look.color, *material.mutable_ambient());
  set_color(look.color, *material.mutable_diffuse());
}

Marker marker_of(const char* name_space, std::uint64_t id, Marker::Type type) {
  Marker marker;
  marker.set_ns(name_space);
  marker.set_id(id);
  marker.set_action(Marker::ADD_MODIFY);
  marker.set_type(type);
  gz_msgs::Set(marker.mutable_scale(), gz_math::Vector3d::One);
  return marker;
}

/// The eight faces of an octahedron around `center`.
void add_octahedron(const Eigen::Vector3d& center, Marker& marker) {
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3d sign((corner & 1) != 0 ? 1.0 : -1.0, (corner & 2) != 0 ? 1.0 : -1.0,
                               (corner & 4) != 0 ? 1.0 : -1.0);
    std::array<int, 3> axes = {0, 1, 2};
    // Seen from outside, all faces must have the same winding order.
    if (sign.prod() < 0.0) std::swap(axes[1], axes[2]);
    for (const int axis : axes) {
      Eigen::Vector3d tip = center;
      tip[axis] += kTagRadius * sign[axis];
      gz_msgs::Set(marker.add_point(), to_gz(tip));
    }
  }
}

/// The shade of a colour; silent tags have a separate one.
int shade_of(const ReadColor& color) {
  const ReadColor silent = silent_color();
  if (color.red == silent.red && color.green == silent.green && color.blue == silent.blue) {
    return kSilent;
  }
  const double share = color.red > 0.0 ? 0.5 + 0.5 * color.red : 0.5 - 0.5 * color.blue;
  return static_cast<int>(std::lround(share * (kSilent - 1)));
}

}  // namespace

struct WindowMarkers::Window {
  gz_transport::Node node;
  std::set<std::pair<std::string, std::uint64_t>> shown;

  [[nodiscard]] bool is_open() const {
    std::vector<gz_transport::ServicePublisher> windows;
    return node.ServiceInfo(kService, windows);
  }
  void show(const Marker& marker) {
    shown.emplace(marker.ns(), marker.id());
    node.Request(kService, marker);
  }
  void hide(const std::pair<std::string, std::uint64_t>& which) {
    Marker marker;
    marker.set_ns(which.first);
    marker.set_id(which.second);
    marker.set_action(Marker::DELETE_MARKER);
    node.Request(kService, marker);
  }
};

WindowMarkers::WindowMarkers() : FieldPicture(kInterval), window_(std::make_unique<Window>()) {}
WindowMarkers::~WindowMarkers() = default;

void WindowMarkers::draw(Time stamp) {
  if (!window_->is_open()) return;
  const auto before = window_->shown;
  window_->shown.clear();
  std::map<int, Marker> by_shade;
  for (const auto& [name, tag] : tags()) {
    const int shade = shade_of(color_of(tag, stamp));
    const auto id = static_cast<std::uint64_t>(shade) + 1;
    const auto found = by_shade.emplace(shade, marker_of(kTags, id, Marker::TRIANGLE_LIST)).first;
    add_octahedron(tag.p_WT, found->second);
  }
  for (auto& [shade, marker] : by_shade) {
    set_look(kShades.at(static_cast<std::size_t>(shade)), marker);
    window_->show(marker);
  }
  std::uint64_t id = 1;
  for (const auto& [name, antenna] : antennas()) {
    const Eigen::Quaterniond& q = antenna.X_WA.rotation;
    const gz_math::Quaterniond rotation(q.w(), q.x(), q.y(), q.z());
    // A cylinder's axis is z; the antenna's boresight is x.
    const gz_math::Quaterniond along_x = rotation * gz_math::Quaterniond(0.0, 0.5 * M_PI, 0.0);
    const gz_math::Vector3d place = to_gz(antenna.X_WA.translation);
    Marker arrow = marker_of(kAntennas, id++, Marker::CYLINDER);
    const gz_math::Vector3d middle =
        place + rotation * gz_math::Vector3d(0.5 * kArrowLength, 0.0, 0.0);
    gz_msgs::Set(arrow.mutable_pose(), gz_math::Pose3d(middle, along_x));
    gz_msgs::Set(arrow.mutable_scale(),
                 gz_math::Vector3d(2.0 * kArrowRadius, 2.0 * kArrowRadius, kArrowLength));
    set_look(kArrow, arrow);
    window_->show(arrow);
    Marker ball = marker_of(kAntennas, id++, Marker::SPHERE);
    gz_msgs::Set(ball.mutable_pose(), gz_math::Pose3d(place, rotation));
    gz_msgs::Set(ball.mutable_scale(), gz_math::Vector3d::One * (2.0 * antenna.range_m));
    set_look(kBall, ball);
    window_->show(ball);
  }
  for (const auto& which : before) {
    if (window_->shown.count(which) == 0) window_->hide(which);
  }
}

}  // namespace tagfield
