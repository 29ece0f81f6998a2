#include "sim/scene_camera.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>

#include "sim/embree_scene.h"
#include "sim/picture_changes.h"
#include "sim/traced_picture.h"

namespace prospect::sim {
namespace {

constexpr float kAlike =
    16.f / 255;  // difference of corners up to which a pixel needs no samples of its own
constexpr float kLift = 2e-4f;  // m above a surface from which its shadow is asked for
constexpr float kFromAbove =
    0.3f;  // share of the even light that comes from above rather than all round

struct View {
  Eigen::Vector3f eye, forward, right, up;  // right and up reach to the picture's edge
};

View MakeView(const CameraDescription& camera, int width, int height) {
  const Eigen::Vector3d forward = (camera.target - camera.eye).normalized();
  const bool steep = std::abs(forward.z()) > 0.999;
  const Eigen::Vector3d above = steep ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d right = forward.cross(above).normalized();
  const double half = std::tan(camera.fov / 2);
  View view;
  view.eye = camera.eye.cast<float>();
  view.forward = forward.cast<float>();
  view.right = (right * half * width / height).cast<float>();
  view.up = (right.cross(forward) * half).cast<float>();
  return view;
}

Eigen::Vector3f Direction(const View& view, float u, float v) {
  return view.forward + view.right * (2 * u - 1) + view.up * (1 - 2 * v);
}

}  // namespace

Eigen::Vector2d SeenAt(const CameraDescription& camera, const Eigen::Vector3d& point) {
  const View view = MakeView(camera, 1, 1);
  const Eigen::Vector3f way = point.cast<float>() - view.eye;
  const float ahead = way.dot(view.forward);
  if (ahead <= 0) return Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());
  const double x = way.dot(view.right) / (ahead * view.right.squaredNorm());
  const double y = way.dot(view.up) / (ahead * view.up.squaredNorm());
  return {0.5 + 0.5 * x, 0.5 - 0.5 * y};
}

struct SceneCamera::Impl {
  // A rigid piece: its triangles at rest, and as a geometry of the scene that follows its pose.
  struct Piece {
    RTCGeometry geometry;
    float* placed;                          // Embree's vertices, three numbers each
    std::vector<Eigen::Vector3f> vertices;  // in the body's frame
    std::vector<Color> colors;              // by triangle
    Eigen::Matrix<float, 3, 4> pose;
  };

  explicit Impl(const SceneVisuals& visuals);
  ~Impl();

  void AddPiece(const VisualBody& visual);
  void Pose(const std::vector<Eigen::Isometry3d>& poses);
  void Place(Piece* piece, const Eigen::Isometry3d& pose);
  const PictureChanges* Changes(const CameraDescription& camera, double light_scale, int width,
                                int height, const std::vector<Eigen::Isometry3d>& poses);
  void Trace(const View& view, const float u[kLanes], const float v[kLanes], Color colors[kLanes],
             Trail trails[kLanes]) const;
  void Shade(const RTCRayHit4& rays, Color colors[kLanes], Trail trails[kLanes]) const;
  void Shadows(const RTCRayHit4& rays, const Eigen::Vector3f normals[kLanes],
               bool lit[kLanes]) const;

  LightDescription light;
  Eigen::Vector3f lamp;
  RTCScene scene;
  std::vector<Piece> pieces;  // the still one first

  // The kept picture: what it shows, and how that came about.
  TracedPicture picture{kAlike};
  PictureChanges changes;
  std::vector<std::vector<PictureChanges::Placed>> parts;  // by piece
  std::array<double, 10> kept = {};                        // its view, light and size
};

SceneCamera::Impl::Impl(const SceneVisuals& visuals)
    : light(visuals.light),
      lamp(visuals.light.towards.cast<float>()),
      scene(rtcNewScene(SharedEmbreeDevice())) {
  rtcSetSceneFlags(scene, RTC_SCENE_FLAG_DYNAMIC);
  rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_LOW);
  AddPiece(visuals.still);
  for (const VisualBody& body : visuals.moving) AddPiece(body);
  parts.resize(1);  // what stands still changes nothing
  for (const VisualBody& body : visuals.moving) parts.push_back(PartBoxes(body));
}

SceneCamera::Impl::~Impl() {
  for (const Piece& piece : pieces) rtcReleaseGeometry(piece.geometry);
  rtcReleaseScene(scene);
}

void SceneCamera::Impl::AddPiece(const VisualBody& visual) {
  Piece piece;
  std::vector<std::uint32_t> corners;
  for (const VisualPart& part : visual) {
    const auto first = static_cast<std::uint32_t>(piece.vertices.size());
    piece.vertices.insert(piece.vertices.end(), part.mesh.vertices.begin(),
                          part.mesh.vertices.end());
    for (const auto& triangle : part.mesh.triangles) {
      for (const std::uint32_t corner : triangle) corners.push_back(first + corner);
      piece.colors.push_back(part.color);
    }
  }
  piece.geometry = rtcNewGeometry(SharedEmbreeDevice(), RTC_GEOMETRY_TYPE_TRIANGLE);
  rtcSetGeometryBuildQuality(piece.geometry, RTC_BUILD_QUALITY_REFIT);

  piece.placed = static_cast<float*>(
      rtcSetNewGeometryBuffer(piece.geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                              3 * sizeof(float), piece.vertices.size()));
  auto* indices = static_cast<std::uint32_t*>(
      rtcSetNewGeometryBuffer(piece.geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(std::uint32_t), piece.colors.size()));
  std::copy(corners.begin(), corners.end(), indices);
  piece.pose.setZero();
  Place(&piece, Eigen::Isometry3d::Identity());
  rtcAttachGeometryByID(scene, piece.geometry, static_cast<unsigned>(pieces.size()));
  pieces.push_back(std::move(piece));
}

void SceneCamera::Impl::Place(Piece* piece, const Eigen::Isometry3d& pose) {
  const Eigen::Matrix<float, 3, 4> to = pose.matrix().topRows<3>().cast<float>();
  if (to == piece->pose) return;
  piece->pose = to;
  float* out = piece->placed;
  for (const Eigen::Vector3f& v : piece->vertices) {
    const Eigen::Vector3f at = to.leftCols<3>() * v + to.col(3);
    out = std::copy_n(at.data(), 3, out);
  }
  rtcUpdateGeometryBuffer(piece->geometry, RTC_BUFFER_TYPE_VERTEX, 0);
  rtcCommitGeometry(piece->geometry);
}

void SceneCamera::Impl::Pose(const std::vector<Eigen::Isometry3d>& poses) {
  if (poses.size() + 1 != pieces.size()) {
    throw std::invalid_argument("the camera has " + std::to_string(pieces.size() - 1) +
                                " moving bodies, not " + std::to_string(poses.size()));
  }
  for (std::size_t i = 0; i < poses.size(); ++i) Place(&pieces[i + 1], poses[i]);
  rtcCommitScene(scene);
}

// What changed since the kept picture, which this one replaces; null if it is not to be kept.
const PictureChanges* SceneCamera::Impl::Changes(const CameraDescription& camera,
                                                 double light_scale, int width, int height,
                                                 const std::vector<Eigen::Isometry3d>& poses) {
  if (!KeepsPicture(width, height)) return nullptr;
  const Eigen::Vector3d& eye = camera.eye;
  const Eigen::Vector3d& target = camera.target;
  const std::array<double, 10> wanted = {eye.x(),     eye.y(),     eye.z(),    target.x(),
                                         target.y(),  target.z(),  camera.fov, light_scale,
                                         1.0 * width, 1.0 * height};
  if (wanted != kept) {
    const View view = MakeView(camera, width, height);
    changes.Start(Projection::Perspective(view.eye.cast<double>(), view.forward.cast<double>(),
                                          view.right.cast<double>(), view.up.cast<double>()),
                  width, height, Projection::Parallel(lamp.cast<double>().normalized()), target,
                  (target - eye).norm());
    kept = wanted;
  }
  for (std::size_t i = 0; i < poses.size(); ++i) {
    for (PictureChanges::Placed& part : parts[i + 1]) part.pose = poses[i];
  }
  changes.Next(parts);
  return &changes;
}

// The colours at kLanes places of the picture (u to the right, v down, 0 to 1).
void SceneCamera::Impl::Trace(const View& view, const float u[kLanes], const float v[kLanes],
                              Color colors[kLanes], Trail trails[kLanes]) const {
  alignas(16) RTCRayHit4 rays = {};
  alignas(16) const int valid[kLanes] = {-1, -1, -1, -1};
  for (int i = 0; i < kLanes; ++i) {
    const Eigen::Vector3f direction = Direction(view, u[i], v[i]);
    rays.ray.org_x[i] = view.eye.x();
    rays.ray.org_y[i] = view.eye.y();
    rays.ray.org_z[i] = view.eye.z();
    rays.ray.dir_x[i] = direction.x();
    rays.ray.dir_y[i] = direction.y();
    rays.ray.dir_z[i] = direction.z();
    rays.ray.tfar[i] = std::numeric_limits<float>::infinity();
    rays.ray.mask[i] = ~0u;
    rays.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
  }
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  rtcIntersect4(valid, scene, &context, &rays);
  Shade(rays, colors, trails);
}

void SceneCamera::Impl::Shade(const RTCRayHit4& rays, Color colors[kLanes],
                              Trail trails[kLanes]) const {
  Eigen::Vector3f normals[kLanes];
  bool lit[kLanes];
  for (int i = 0; i < kLanes; ++i) {
    lit[i] = false;
    trails[i] = {};
    normals[i].setZero();
    if (rays.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) continue;
    normals[i] = {rays.hit.Ng_x[i], rays.hit.Ng_y[i], rays.hit.Ng_z[i]};
    normals[i].normalize();
    const Eigen::Vector3f ray(rays.ray.dir_x[i], rays.ray.dir_y[i], rays.ray.dir_z[i]);
    if (normals[i].dot(ray) > 0) normals[i] = -normals[i];
    lit[i] = normals[i].dot(lamp) > 0;
    trails[i].piece = static_cast<int>(rays.hit.geomID[i]);
    if (!lit[i]) continue;
    const Eigen::Vector3f origin(rays.ray.org_x[i], rays.ray.org_y[i], rays.ray.org_z[i]);
    trails[i].lamp_cell = changes.LampCell(origin + rays.ray.tfar[i] * ray);
  }
  Shadows(rays, normals, lit);
  const auto even = static_cast<float>(light.ambient);
  for (int i = 0; i < kLanes; ++i) {
    if (rays.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) {
      colors[i] = light.sky;
      continue;
    }
    trails[i].lit = lit[i];
    const float direct = lit[i] ? normals[i].dot(lamp) : 0.f;
    const float around = 1 - kFromAbove + kFromAbove * normals[i].z();
    colors[i] = pieces[rays.hit.geomID[i]].colors[rays.hit.primID[i]] *
                (even * around + (1 - even) * direct);
  }
}

// Clears `lit` where something stands between the surface and the lamp.
void SceneCamera::Impl::Shadows(const RTCRayHit4& rays, const Eigen::Vector3f normals[kLanes],
                                bool lit[kLanes]) const {
  alignas(16) RTCRay4 shadows = {};
  alignas(16) int valid[kLanes];
  for (int i = 0; i < kLanes; ++i) {
    valid[i] = lit[i] ? -1 : 0;
    const float t = lit[i] ? rays.ray.tfar[i] : 0.f;
    shadows.org_x[i] = rays.ray.org_x[i] + t * rays.ray.dir_x[i] + kLift * normals[i].x();
    shadows.org_y[i] = rays.ray.org_y[i] + t * rays.ray.dir_y[i] + kLift * normals[i].y();
    shadows.org_z[i] = rays.ray.org_z[i] + t * rays.ray.dir_z[i] + kLift * normals[i].z();
    shadows.dir_x[i] = lamp.x();
    shadows.dir_y[i] = lamp.y();
    shadows.dir_z[i] = lamp.z();
    shadows.tfar[i] = std::numeric_limits<float>::infinity();
    shadows.mask[i] = ~0u;
  }
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  rtcOccluded4(valid, scene, &context, &shadows);
  for (int i = 0; i < kLanes; ++i) lit[i] = lit[i] && shadows.tfar[i] >= 0;
}

SceneCamera::SceneCamera(const SceneVisuals& visuals) : impl_(std::make_unique<Impl>(visuals)) {}

SceneCamera::~SceneCamera() = default;

Image SceneCamera::Render(const CameraDescription& camera,
                          const std::vector<Eigen::Isometry3d>& poses, double light, int width,
                          int height) {
  CheckPictureSize(width, height);
  impl_->Pose(poses);
  const View view = MakeView(camera, width, height);
  return impl_->picture.Render(width, height, light,
                               impl_->Changes(camera, light, width, height, poses),
                               [&](const float* u, const float* v, Color* colors, Trail* trails) {
                                 impl_->Trace(view, u, v, colors, trails);
                               });
}

DepthImage SceneCamera::RenderDepth(const CameraDescription& camera,
                                    const std::vector<Eigen::Isometry3d>& poses, int width,
                                    int height) {
  CheckPictureSize(width, height);
  impl_->Pose(poses);
  const View view = MakeView(camera, width, height);
  DepthImage image;
  image.width = width;
  image.height = height;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const Eigen::Vector3f d = Direction(view, (x + 0.5f) / width, (y + 0.5f) / height);
      RTCRayHit ray = {};
      ray.ray = {view.eye.x(),
                 view.eye.y(),
                 view.eye.z(),
                 0,
                 d.x(),
                 d.y(),
                 d.z(),
                 0,
                 std::numeric_limits<float>::infinity(),
                 ~0u,
                 0,
                 0};
      ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
      RTCIntersectContext context;
      rtcInitIntersectContext(&context);
      rtcIntersect1(impl_->scene, &context, &ray);
      const bool hit = ray.hit.geomID != RTC_INVALID_GEOMETRY_ID;
      image.depth.push_back(ray.ray.tfar);  // the ray's direction has length 1 along the axis
      image.body.push_back(hit ? static_cast<int>(ray.hit.geomID) - 1 : DepthImage::kSky);
    }
  }
  return image;
}

}  // namespace prospect::sim
