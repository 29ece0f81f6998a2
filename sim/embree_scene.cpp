#include "sim/embree_scene.h"

#include <algorithm>
#include <cstdint>
#include <stdexcept>

namespace prospect::sim {

RTCDevice SharedEmbreeDevice() {
  static const RTCDevice device = rtcNewDevice("threads=1,isa=sse4.2");
  if (device == nullptr) throw std::runtime_error("Embree gives no device: is libembree3 whole?");
  return device;
}

EmbreeBody::EmbreeBody(const VisualBody& body) : scene_(rtcNewScene(SharedEmbreeDevice())) {
  for (const VisualPart& part : body) Add(part);
  rtcCommitScene(scene_);
}

EmbreeBody::~EmbreeBody() { rtcReleaseScene(scene_); }

void EmbreeBody::Add(const VisualPart& part) {
  const Mesh& mesh = part.mesh;
  const RTCGeometry geometry = rtcNewGeometry(SharedEmbreeDevice(), RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                               RTC_FORMAT_FLOAT3, 3 * sizeof(float),
                                                               mesh.vertices.size()));
  for (const Eigen::Vector3f& v : mesh.vertices) vertices = std::copy_n(v.data(), 3, vertices);
  auto* corners = static_cast<std::uint32_t*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(std::uint32_t), mesh.triangles.size()));
  for (const auto& triangle : mesh.triangles) corners = std::copy_n(triangle.begin(), 3, corners);
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(scene_, geometry, static_cast<unsigned>(colors_.size()));
  rtcReleaseGeometry(geometry);
  colors_.push_back(part.color);
}

}  // namespace prospect::sim
