#include "sim/camera.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <stdexcept>
#include <string>
#include <utility>

#include "sim/embree_scene.h"

namespace prospect::sim {
namespace {

constexpr int kGrid = 3;  // samples a pixel along each side
constexpr int kSamples = kGrid * kGrid;
constexpr float kAmbient = 0.45f;  // brightness of a face that the light only grazes

struct Hit {
  float distance = std::numeric_limits<float>::infinity();  // in units of the ray's direction
  Color color = Color::Zero();
};

// One rigid body as Embree sees it.
class TracedBody {
 public:
  explicit TracedBody(const VisualBody& body) : scene_(rtcNewScene(SharedEmbreeDevice())) {
    for (const VisualPart& part : body) Add(part);
    rtcCommitScene(scene_);
    for (const VisualPart& part : body) {
      for (const Eigen::Vector3f& v : part.mesh.vertices) radius_ = std::max(radius_, v.norm());
    }
  }
  ~TracedBody() { rtcReleaseScene(scene_); }
  TracedBody(const TracedBody&) = delete;
  TracedBody& operator=(const TracedBody&) = delete;

  float radius() const { return radius_; }  // of the sphere about the body's origin that holds it

  // The nearest hit before `limit`, with `to_site` the rotation that brings the body's normals into
  // the site's frame.
  bool Trace(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction, float limit,
             const Eigen::Matrix3f& to_site, Hit* hit) const {
    RTCRayHit query = Query(origin, direction, limit);
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    rtcIntersect1(scene_, &context, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;
    const Eigen::Vector3f normal(query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z);
    const float up = std::abs(to_site.row(2).dot(normal)) / normal.norm();
    hit->distance = query.ray.tfar;
    hit->color = colors_[query.hit.geomID] * (kAmbient + (1 - kAmbient) * up);
    return true;
  }

 private:
  static RTCRayHit Query(const Eigen::Vector3f& o, const Eigen::Vector3f& d, float limit) {
    RTCRayHit query = {};
    query.ray.org_x = o.x();
    query.ray.org_y = o.y();
    query.ray.org_z = o.z();
    query.ray.dir_x = d.x();
    query.ray.dir_y = d.y();
    query.ray.dir_z = d.z();
    query.ray.tfar = limit;
    query.ray.mask = ~0u;
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    return query;
  }

  void Add(const VisualPart& part) {
    const Mesh& mesh = part.mesh;
    RTCGeometry geometry = rtcNewGeometry(SharedEmbreeDevice(), RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                3 * sizeof(float), mesh.vertices.size()));
    for (const Eigen::Vector3f& v : mesh.vertices) {
      for (int k = 0; k < 3; ++k) *vertices++ = v[k];
    }
    auto* corners = static_cast<std::uint32_t*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                3 * sizeof(std::uint32_t), mesh.triangles.size()));
    for (const auto& triangle : mesh.triangles) corners = std::copy_n(triangle.begin(), 3, corners);
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene_, geometry, static_cast<unsigned>(colors_.size()));
    rtcReleaseGeometry(geometry);
    colors_.push_back(part.color);
  }

  RTCScene scene_;
  std::vector<Color> colors_;  // by geometry
  float radius_ = 0;
};

std::uint8_t ToByte(float value) {
  return static_cast<std::uint8_t>(std::clamp(std::lround(value * 255.f), 0L, 255L));
}

}  // namespace

struct AerialCamera::Impl {
  // The still scene at one picture size: sample by sample, so that moving bodies can be put before
  // it.
  struct Background {
    int width = 0;
    int height = 0;
    std::vector<Hit> samples;
    double light = 0;
    Image image;
  };
  struct Box {
    int left, right, top, bottom;  // pixels, right and bottom past the end
  };
  // A body for this picture: rays are brought into its frame.
  struct Mover {
    const TracedBody* body;
    Eigen::Matrix3f to_site;
    Eigen::Matrix3f to_body;
    Eigen::Vector3f origin;  // of all rays, in the body's frame
    Box box;
  };

  Impl(const AerialView& aerial_view, GroundColor ground_color, const VisualBody& still_body)
      : view(aerial_view), ground(std::move(ground_color)), still(still_body) {
    if (!(std::abs(view.tilt) < M_PI / 4)) {
      throw std::invalid_argument("an aerial camera is tilted by less than 45 degrees");
    }
    if (view.tilt == 0) return;
    turn = Eigen::AngleAxisf(static_cast<float>(view.tilt), Eigen::Vector3f::UnitY());
    eye = turn * eye;
  }

  // Direction of the ray through picture position (u, v) in pixels, as long as the way to the
  // ground of a camera that is not tilted.
  Eigen::Vector3f Direction(float u, float v, int width, int height) const {
    const auto scale = static_cast<float>(2 * view.half_extent / std::min(width, height));
    const Eigen::Vector3f straight((u - 0.5f * width) * scale, (0.5f * height - v) * scale,
                                   -static_cast<float>(view.height));
    return view.tilt == 0 ? straight : turn * straight;
  }

  Eigen::Vector3f SampleDirection(int x, int y, int sample, int width, int height) const {
    const float u = x + (sample % kGrid + 0.5f) / kGrid;
    const float v = y + (sample / kGrid + 0.5f) / kGrid;
    return Direction(u, v, width, height);
  }

  Hit TraceStill(const Eigen::Vector3f& direction) const {
    Hit hit;
    const float far = -eye.z() / direction.z();  // where the ground is; 1 without a tilt
    if (still.Trace(eye, direction, far, Eigen::Matrix3f::Identity(), &hit)) return hit;
    return {far, ground(eye.x() + far * direction.x(), eye.y() + far * direction.y())};
  }

  const Background& BackgroundFor(int width, int height, double light, Background* spare);
  void FillSamples(Background* background) const;
  void FillImage(Background* background, double light) const;
  Mover MakeMover(std::size_t index, const Eigen::Isometry3d& pose, int width, int height) const;
  Box BoxOf(const Eigen::Vector3d& centre, double radius, int width, int height) const;
  std::vector<Mover> MakeMovers(const std::vector<Eigen::Isometry3d>& poses, int width,
                                int height) const;
  Color PixelWith(const std::vector<Mover>& movers, const Background& background, int x,
                  int y) const;

  AerialView view;
  Eigen::Matrix3f turn = Eigen::Matrix3f::Identity();
  Eigen::Vector3f eye{0, 0, static_cast<float>(view.height)};
  GroundColor ground;
  TracedBody still;
  std::vector<std::unique_ptr<TracedBody>> moving;
  Background small;  // kept for the size used last, if it is small
};

void AerialCamera::Impl::FillSamples(Background* background) const {
  const int width = background->width;
  const int height = background->height;
  background->samples.resize(static_cast<std::size_t>(width) * height * kSamples);
  Hit* sample = background->samples.data();
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int s = 0; s < kSamples; ++s)
        *sample++ = TraceStill(SampleDirection(x, y, s, width, height));
    }
  }
}

void AerialCamera::Impl::FillImage(Background* background, double light) const {
  Image& image = background->image;
  image.width = background->width;
  image.height = background->height;
  image.rgb.resize(background->samples.size() / kSamples * 3);
  background->light = light;
  const auto scale = static_cast<float>(light / kSamples);
  const Hit* sample = background->samples.data();
  for (std::size_t i = 0; i < image.rgb.size(); i += 3) {
    Color sum = Color::Zero();
    for (int s = 0; s < kSamples; ++s) sum += (sample++)->color;
    for (int k = 0; k < 3; ++k) image.rgb[i + k] = ToByte(sum[k] * scale);
  }
}

const AerialCamera::Impl::Background& AerialCamera::Impl::BackgroundFor(int width, int height,
                                                                        double light,
                                                                        Background* spare) {
  Background& background = width * height <= 128 * 128 ? small : *spare;
  if (background.width != width || background.height != height) {
    background.width = width;
    background.height = height;
    FillSamples(&background);
    background.light = 0;
  }
  if (background.light != light) FillImage(&background, light);
  return background;
}

// The pixels that a sphere may cover: its outline is widest seen at the heights of its top and
// bottom. Under a tilt, all: that is rare, and pictures are small.
AerialCamera::Impl::Box AerialCamera::Impl::BoxOf(const Eigen::Vector3d& centre, double radius,
                                                  int width, int height) const {
  if (view.tilt != 0) return {0, width, 0, height};
  const double scale = std::min(width, height) / (2 * view.half_extent);
  double low[2] = {1e9, 1e9};
  double high[2] = {-1e9, -1e9};
  for (double z : {centre.z() - radius, centre.z() + radius}) {
    const double magnify = view.height / std::max(0.1, view.height - z);
    for (int k = 0; k < 2; ++k) {
      low[k] = std::min({low[k], (centre[k] - radius) * magnify});
      high[k] = std::max({high[k], (centre[k] + radius) * magnify});
    }
  }
  const auto clip = [](double value, int end) {
    return static_cast<int>(std::clamp(value, 0.0, static_cast<double>(end)));
  };
  return {clip(std::floor(0.5 * width + low[0] * scale), width),
          clip(std::ceil(0.5 * width + high[0] * scale) + 1, width),
          clip(std::floor(0.5 * height - high[1] * scale), height),
          clip(std::ceil(0.5 * height - low[1] * scale) + 1, height)};
}

AerialCamera::Impl::Mover AerialCamera::Impl::MakeMover(std::size_t index,
                                                        const Eigen::Isometry3d& pose, int width,
                                                        int height) const {
  Mover mover;
  mover.body = moving[index].get();
  mover.to_site = pose.linear().cast<float>();
  mover.to_body = mover.to_site.transpose();
  const Eigen::Vector3d from = eye.cast<double>();
  mover.origin = (pose.linear().transpose() * (from - pose.translation())).cast<float>();
  mover.box = BoxOf(pose.translation(), mover.body->radius(), width, height);
  return mover;
}

std::vector<AerialCamera::Impl::Mover> AerialCamera::Impl::MakeMovers(
    const std::vector<Eigen::Isometry3d>& poses, int width, int height) const {
  if (poses.size() != moving.size()) {
    throw std::invalid_argument("the camera has " + std::to_string(moving.size()) +
                                " moving bodies, not " + std::to_string(poses.size()));
  }
  if (width < 1 || height < 1 || width > 2048 || height > 2048) {
    throw std::invalid_argument("a picture is 1 to 2048 pixels wide and high");
  }
  std::vector<Mover> movers;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    movers.push_back(MakeMover(i, poses[i], width, height));
  }
  return movers;
}

Color AerialCamera::Impl::PixelWith(const std::vector<Mover>& movers, const Background& background,
                                    int x, int y) const {
  const std::size_t first = (static_cast<std::size_t>(y) * background.width + x) * kSamples;
  Color sum = Color::Zero();
  for (int s = 0; s < kSamples; ++s) {
    Hit nearest = background.samples[first + s];
    const Eigen::Vector3f direction = SampleDirection(x, y, s, background.width, background.height);
    for (const Mover& mover : movers) {
      mover.body->Trace(mover.origin, mover.to_body * direction, nearest.distance, mover.to_site,
                        &nearest);
    }
    sum += nearest.color;
  }
  return sum;
}

AerialCamera::AerialCamera(const AerialView& view, GroundColor ground, const VisualBody& still,
                           const std::vector<VisualBody>& moving)
    : impl_(std::make_unique<Impl>(view, std::move(ground), still)) {
  for (const VisualBody& body : moving) {
    impl_->moving.push_back(std::make_unique<TracedBody>(body));
  }
}

AerialCamera::~AerialCamera() = default;

Image AerialCamera::Render(const std::vector<Eigen::Isometry3d>& poses, double light, int width,
                           int height) {
  const std::vector<Impl::Mover> movers = impl_->MakeMovers(poses, width, height);
  Impl::Background spare;
  const Impl::Background& background = impl_->BackgroundFor(width, height, light, &spare);
  Image image = background.image;
  const auto scale = static_cast<float>(light / kSamples);
  for (const Impl::Mover& mover : movers) {  // overlapping boxes only repeat the same pixels
    for (int y = mover.box.top; y < mover.box.bottom; ++y) {
      for (int x = mover.box.left; x < mover.box.right; ++x) {
        const Color sum = impl_->PixelWith(movers, background, x, y);
        std::uint8_t* pixel = &image.rgb[(static_cast<std::size_t>(y) * width + x) * 3];
        for (int k = 0; k < 3; ++k) pixel[k] = ToByte(sum[k] * scale);
      }
    }
  }
  return image;
}

int AerialCamera::CountMovingPixels(const std::vector<Eigen::Isometry3d>& poses, int width,
                                    int height) {
  const std::vector<Impl::Mover> movers = impl_->MakeMovers(poses, width, height);
  int count = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const Eigen::Vector3f direction = impl_->Direction(x + 0.5f, y + 0.5f, width, height);
      const Hit still = impl_->TraceStill(direction);
      Hit hit;
      const auto covers = [&](const Impl::Mover& mover) {
        return mover.body->Trace(mover.origin, mover.to_body * direction, still.distance,
                                 mover.to_site, &hit);
      };
      count += std::any_of(movers.begin(), movers.end(), covers);
    }
  }
  return count;
}

}  // namespace prospect::sim
