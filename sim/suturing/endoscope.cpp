#include "sim/suturing/endoscope.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>

#include "sim/embree_scene.h"
#include "sim/picture_changes.h"
#include "sim/suturing/suturing_world.h"
#include "sim/suturing/visuals.h"
#include "sim/traced_picture.h"

namespace prospect::sim {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr float kAlike = 14.f / 255;  // difference of corners that needs no samples of its own
constexpr float kLift = 1e-4f;        // m above a surface from which its shadow is asked for
constexpr float kThreadRadius = 0.42e-3f;
constexpr int kThreadPoints = 96;  // at most, of all strands
constexpr float kExposure = 1.12f;
constexpr float kAmbient = 0.32f;
constexpr float kVignette = 0.42f;  // darkening in the corners

const Vector3f kHidden(-20e-3f, -20e-3f, -4e-3f);  // inside the pad

// How a thing shines: strength and narrowness of its highlight.
struct Gloss {
  float strength;
  int doublings;  // the highlight is the cosine to the power of 2 ^ doublings
};
constexpr Gloss kMetal = {0.55f, 5}, kWet = {0.10f, 5}, kPlastic = {0.20f, 4};

struct View {
  Vector3f eye, forward, right, up;  // right and up reach to the picture's edge
};

View MakeView(const SuturingLook& look, double sideways, int width, int height) {
  const Vector3d forward = (look.target - look.eye).normalized();
  const Vector3d right = forward.cross(Vector3d::UnitZ()).normalized();
  const double half = std::tan(look.fov / 2);
  View view;
  view.eye = (look.eye + sideways * right).cast<float>();
  view.forward = forward.cast<float>();
  view.right = (right * half * width / height).cast<float>();
  view.up = (right.cross(forward) * half).cast<float>();
  return view;
}

}  // namespace

struct Endoscope::Impl {
  struct Piece {
    RTCGeometry geometry = nullptr;
    float* placed = nullptr;         // Embree's vertices, three numbers each
    std::vector<Vector3f> vertices;  // in the body's frame
    std::vector<Color> colors;       // by triangle
    Gloss gloss = kMetal;
  };

  Impl(const SuturingParameters& p, const SuturingLook& look);
  ~Impl();

  void AddPiece(const VisualBody& visual, const Gloss& gloss);
  void AddThread();
  void Place(Piece* piece, const Isometry3d& pose);
  void PlaceThread(const std::vector<Strand>& strands);
  const PictureChanges* Changes(const View& view, const std::array<double, 4>& wanted,
                                const std::vector<Isometry3d>& poses,
                                const std::vector<Strand>& strands);
  void Trace(const View& view, const float u[kLanes], const float v[kLanes], Color colors[kLanes],
             Trail trails[kLanes]) const;
  void Lit(const Vector3f at[kLanes], const Vector3f normals[kLanes], bool lit[kLanes]) const;
  Color Shaded(unsigned geometry, unsigned primitive, const Vector3f& at, const Vector3f& normal,
               const Vector3f& ray, bool lit) const;

  SuturingLook look;
  PadTexture texture;
  Vector3f lamp = Vector3f::Zero();
  float lamp_distance = 1;
  RTCScene scene;
  std::vector<Piece> pieces;  // what stands still first
  RTCGeometry thread = nullptr;
  float* thread_points = nullptr;          // x, y, z, radius
  std::uint32_t* thread_starts = nullptr;  // first point of each piece of thread

  // The kept picture: what it shows, and how that came about.
  TracedPicture picture{kAlike};
  PictureChanges changes;
  std::vector<std::vector<PictureChanges::Placed>> parts;  // by piece, the thread's last
  std::array<double, 4> kept = {};                         // its eye, light and size
};

Endoscope::Impl::Impl(const SuturingParameters& p, const SuturingLook& the_look)
    : look(the_look), texture(p, the_look), scene(rtcNewScene(SharedEmbreeDevice())) {
  AddPiece(StillVisual(p, look), kWet);
  for (int hand = 0; hand < 2; ++hand) {
    AddPiece(JawVisual(p), kMetal);
    AddPiece(JawVisual(p), kMetal);
    AddPiece(WristVisual(p), kMetal);
    AddPiece(ShaftVisual(p), kPlastic);
  }
  AddPiece(NeedleVisual(p), kMetal);
  AddThread();
  parts.front().clear();  // what stands still changes nothing
  parts.emplace_back();
  lamp = (look.eye + Vector3d(-0.012, 0.004, 0.008)).cast<float>();
  lamp_distance = (lamp - look.target.cast<float>()).norm();
}

Endoscope::Impl::~Impl() {
  for (const Piece& piece : pieces) rtcReleaseGeometry(piece.geometry);
  rtcReleaseGeometry(thread);
  rtcReleaseScene(scene);
}

void Endoscope::Impl::AddPiece(const VisualBody& visual, const Gloss& gloss) {
  Piece piece;
  piece.gloss = gloss;
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
  piece.placed = static_cast<float*>(
      rtcSetNewGeometryBuffer(piece.geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                              3 * sizeof(float), piece.vertices.size()));
  auto* indices = static_cast<std::uint32_t*>(
      rtcSetNewGeometryBuffer(piece.geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(std::uint32_t), piece.colors.size()));
  std::copy(corners.begin(), corners.end(), indices);
  Place(&piece, Isometry3d::Identity());
  rtcAttachGeometryByID(scene, piece.geometry, static_cast<unsigned>(pieces.size()));
  pieces.push_back(std::move(piece));
  parts.push_back(PartBoxes(visual));
}

// The thread is a chain of round segments; those not in use are points inside the pad.
void Endoscope::Impl::AddThread() {
  thread = rtcNewGeometry(SharedEmbreeDevice(), RTC_GEOMETRY_TYPE_ROUND_LINEAR_CURVE);
  thread_points = static_cast<float*>(rtcSetNewGeometryBuffer(
      thread, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, 4 * sizeof(float), kThreadPoints + 2));
  thread_starts = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
      thread, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT, sizeof(std::uint32_t), kThreadPoints));
  PlaceThread({});
  rtcAttachGeometryByID(scene, thread, static_cast<unsigned>(pieces.size()));
}

void Endoscope::Impl::Place(Piece* piece, const Isometry3d& pose) {
  const Eigen::Matrix<float, 3, 4> to = pose.matrix().topRows<3>().cast<float>();
  float* out = piece->placed;
  for (const Vector3f& v : piece->vertices) {
    const Vector3f at = to.leftCols<3>() * v + to.col(3);
    out = std::copy_n(at.data(), 3, out);
  }
  rtcUpdateGeometryBuffer(piece->geometry, RTC_BUFFER_TYPE_VERTEX, 0);
  rtcCommitGeometry(piece->geometry);
}

void Endoscope::Impl::PlaceThread(const std::vector<Strand>& strands) {
  int points = 0, segments = 0;
  const auto put = [this](int i, const Vector3f& at) {
    std::copy_n(at.data(), 3, thread_points + 4 * i);
    thread_points[4 * i + 3] = kThreadRadius;
  };
  for (const Strand& strand : strands) {
    for (std::size_t i = 0; i < strand.size() && points < kThreadPoints; ++i) {
      if (i > 0) thread_starts[segments++] = static_cast<std::uint32_t>(points - 1);
      put(points++, strand[i].cast<float>());
    }
  }
  for (int i = points; i < kThreadPoints + 2; ++i) put(i, kHidden);
  while (segments < kThreadPoints) thread_starts[segments++] = kThreadPoints;
  rtcUpdateGeometryBuffer(thread, RTC_BUFFER_TYPE_VERTEX, 0);
  rtcUpdateGeometryBuffer(thread, RTC_BUFFER_TYPE_INDEX, 0);
  rtcCommitGeometry(thread);
}

// What changed since the kept picture, which this one replaces.
const PictureChanges* Endoscope::Impl::Changes(const View& view,
                                               const std::array<double, 4>& wanted,
                                               const std::vector<Isometry3d>& poses,
                                               const std::vector<Strand>& strands) {
  if (wanted != kept) {
    const Vector3d forward = view.forward.cast<double>();
    const Vector3d right = view.right.cast<double>(), up = view.up.cast<double>();
    constexpr double kLampReach = 1.4;  // half pictures
    changes.Start(Projection::Perspective(view.eye.cast<double>(), forward, right, up),
                  static_cast<int>(wanted[2]), static_cast<int>(wanted[3]),
                  Projection::Perspective(lamp.cast<double>(), forward, right, up), look.target,
                  kLampReach);
    kept = wanted;
  }
  for (std::size_t i = 0; i < poses.size(); ++i) {
    for (PictureChanges::Placed& part : parts[i + 1]) part.pose = poses[i];
  }
  parts.back().clear();
  for (const Strand& strand : strands) {
    for (std::size_t i = 1; i < strand.size(); ++i) {
      Eigen::AlignedBox3d box(strand[i - 1].cwiseMin(strand[i]), strand[i - 1].cwiseMax(strand[i]));
      box.min().array() -= 1.01 * kThreadRadius;
      box.max().array() += 1.01 * kThreadRadius;
      parts.back().push_back({box});
    }
  }
  changes.Next(parts);
  return &changes;
}

// The colours at kLanes places of the picture (u to the right, v down, 0 to 1).
void Endoscope::Impl::Trace(const View& view, const float u[kLanes], const float v[kLanes],
                            Color colors[kLanes], Trail trails[kLanes]) const {
  alignas(16) RTCRayHit4 rays = {};
  alignas(16) const int valid[kLanes] = {-1, -1, -1, -1};
  Vector3f directions[kLanes], at[kLanes], normals[kLanes];
  bool lit[kLanes];
  for (int i = 0; i < kLanes; ++i) {
    directions[i] = view.forward + view.right * (2 * u[i] - 1) + view.up * (1 - 2 * v[i]);
    rays.ray.org_x[i] = view.eye.x();
    rays.ray.org_y[i] = view.eye.y();
    rays.ray.org_z[i] = view.eye.z();
    rays.ray.dir_x[i] = directions[i].x();
    rays.ray.dir_y[i] = directions[i].y();
    rays.ray.dir_z[i] = directions[i].z();
    rays.ray.tfar[i] = std::numeric_limits<float>::infinity();
    rays.ray.mask[i] = ~0u;
    rays.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
  }
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  rtcIntersect4(valid, scene, &context, &rays);
  for (int i = 0; i < kLanes; ++i) {
    lit[i] = rays.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID;
    colors[i].setZero();
    trails[i] = {};
    if (!lit[i]) continue;
    trails[i].piece = static_cast<int>(rays.hit.geomID[i]);
    normals[i] = Vector3f(rays.hit.Ng_x[i], rays.hit.Ng_y[i], rays.hit.Ng_z[i]).normalized();
    if (normals[i].dot(directions[i]) > 0) normals[i] = -normals[i];
    at[i] = view.eye + rays.ray.tfar[i] * directions[i] + kLift * normals[i];
    if (normals[i].dot(lamp - at[i]) > 0) trails[i].lamp_cell = changes.LampCell(at[i]);
  }
  Lit(at, normals, lit);
  for (int i = 0; i < kLanes; ++i) {
    if (rays.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) continue;
    trails[i].lit = lit[i];
    const float x = 2 * u[i] - 1, y = 2 * v[i] - 1;
    const float corner = (x * x + y * y) / 2;
    colors[i] = Shaded(rays.hit.geomID[i], rays.hit.primID[i], at[i], normals[i],
                       directions[i].normalized(), lit[i]) *
                (1 - kVignette * corner);
  }
}

// Clears `lit` where a surface is turned away from the lamp or in a shadow.
void Endoscope::Impl::Lit(const Vector3f at[kLanes], const Vector3f normals[kLanes],
                          bool lit[kLanes]) const {
  alignas(16) RTCRay4 shadows = {};
  alignas(16) int valid[kLanes];
  for (int i = 0; i < kLanes; ++i) {
    const Vector3f way = lit[i] ? Vector3f(lamp - at[i]) : Vector3f::UnitZ();
    lit[i] = lit[i] && normals[i].dot(way) > 0;
    valid[i] = lit[i] ? -1 : 0;
    const Vector3f from = lit[i] ? at[i] : Vector3f::Zero();
    shadows.org_x[i] = from.x();
    shadows.org_y[i] = from.y();
    shadows.org_z[i] = from.z();
    shadows.dir_x[i] = way.x();
    shadows.dir_y[i] = way.y();
    shadows.dir_z[i] = way.z();
    shadows.tfar[i] = 0.999f;
    shadows.mask[i] = ~0u;
  }
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  rtcOccluded4(valid, scene, &context, &shadows);
  for (int i = 0; i < kLanes; ++i) lit[i] = lit[i] && shadows.tfar[i] >= 0;
}

Color Endoscope::Impl::Shaded(unsigned geometry, unsigned primitive, const Vector3f& at,
                              const Vector3f& normal, const Vector3f& ray, bool lit) const {
  const bool is_thread = geometry == pieces.size();
  Color color = is_thread ? look.thread : pieces[geometry].colors[primitive];
  const bool pad_top = geometry == 0 && normal.z() > 0.9f && at.z() > -5e-4f;
  if (pad_top) color = texture.At(at.x(), at.y());
  const Vector3f way = lamp - at;
  const float distance = way.norm();
  const Vector3f to_lamp = way / distance;
  const float nearness = lamp_distance / distance;
  const float light = kExposure * nearness * std::sqrt(nearness);
  const float direct = lit ? normal.dot(to_lamp) : 0.f;
  Color out = color * (kAmbient + (1 - kAmbient) * direct) * light;
  if (!lit) return out;
  const Gloss gloss = is_thread ? kPlastic : pieces[geometry].gloss;
  float mirror = std::max(0.f, normal.dot((to_lamp - ray).normalized()));
  for (int i = 0; i < gloss.doublings; ++i) mirror *= mirror;
  return out + Color::Constant(gloss.strength * mirror * light);
}

Endoscope::Endoscope(const SuturingParameters& parameters, const SuturingLook& look)
    : impl_(std::make_unique<Impl>(parameters, look)) {}

Endoscope::~Endoscope() = default;

Image Endoscope::Render(const std::vector<Isometry3d>& poses, const std::vector<Strand>& thread,
                        double light, double sideways, int width, int height) {
  CheckPictureSize(width, height);
  if (poses.size() != kMoving) {
    throw std::invalid_argument("the endoscope sees " + std::to_string(kMoving) +
                                " moving things, not " + std::to_string(poses.size()));
  }
  for (int i = 0; i < kMoving; ++i) impl_->Place(&impl_->pieces[i + 1], poses[i]);
  impl_->PlaceThread(thread);
  rtcCommitScene(impl_->scene);
  const View view = MakeView(impl_->look, sideways, width, height);
  const PictureChanges* changes =
      KeepsPicture(width, height)
          ? impl_->Changes(view, {sideways, light, 1.0 * width, 1.0 * height}, poses, thread)
          : nullptr;
  return impl_->picture.Render(width, height, light, changes,
                               [&](const float* u, const float* v, Color* colors, Trail* trails) {
                                 impl_->Trace(view, u, v, colors, trails);
                               });
}

Eigen::Vector2d SeenAt(const SuturingLook& look, const Vector3d& point, int width, int height) {
  const View view = MakeView(look, 0, width, height);
  const Vector3f way = point.cast<float>() - view.eye;
  const float ahead = way.dot(view.forward);
  if (ahead <= 0) return Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());
  return {0.5 + 0.5 * way.dot(view.right) / (ahead * view.right.squaredNorm()),
          0.5 - 0.5 * way.dot(view.up) / (ahead * view.up.squaredNorm())};
}

void AppendInstrument(const SuturingParameters& p, int hand, const Isometry3d& pose, double opening,
                      std::vector<Isometry3d>* poses) {
  const Isometry3d pin = pose * Eigen::Translation3d(0, 0, -p.wrist);
  for (const double side : {1.0, -1.0}) {
    Isometry3d jaw = pin * Eigen::AngleAxisd(side * opening / 2, Vector3d::UnitY());
    if (side < 0) jaw = jaw * Eigen::AngleAxisd(M_PI, Vector3d::UnitZ());
    poses->push_back(jaw);
  }
  poses->push_back(pin);
  const Vector3d trocar(hand == kRightHand ? p.trocar_x : -p.trocar_x, p.trocar_y, p.trocar_z);
  Isometry3d shaft = Isometry3d::Identity();
  shaft.translation() = pin.translation();
  shaft.linear() = Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), trocar - pin.translation())
                       .toRotationMatrix();
  poses->push_back(shaft);
}

}  // namespace prospect::sim
