#include "model/training/views.h"

#include <cmath>

namespace prospect::model {
namespace {

constexpr double kShift = 0.05, kTurn = 2 * M_PI / 180, kZoom = 0.05, kTint = 0.08;
constexpr std::uint64_t kCameraStream = 0x63616d657261ULL;

struct Camera {
  double x, y, turn, zoom;  // x and y as shares of the picture's size, turn in radians
  double tint[3];
};

Camera CameraOf(int element) {
  CounterRandom random(kCameraStream, static_cast<std::uint64_t>(element), 0);
  const auto within = [&random](double range) { return range * (2 * random.Uniform() - 1); };
  Camera camera{};
  camera.x = within(kShift);
  camera.y = within(kShift);
  camera.turn = within(kTurn);
  camera.zoom = 1 + within(kZoom);
  for (double& tint : camera.tint) tint = 1 + within(kTint);
  return camera;
}

/// What the camera sees beyond the picture's edge is the edge.
torch::Tensor Moved(const torch::Tensor& pictures, const Camera& camera) {
  const auto height = static_cast<double>(pictures.size(2));
  const auto width = static_cast<double>(pictures.size(3));
  const double c = camera.zoom * std::cos(camera.turn), s = camera.zoom * std::sin(camera.turn);
  // From places of the new picture, -1 to 1 along each side, to those of the old one.
  const torch::Tensor theta =
      torch::tensor({c, -s * height / width, 2 * camera.x, s * width / height, c, 2 * camera.y},
                    pictures.options())
          .view({1, 2, 3})
          .expand({pictures.size(0), 2, 3});
  namespace F = torch::nn::functional;
  return F::grid_sample(
      pictures, F::affine_grid(theta, pictures.sizes(), false),
      F::GridSampleFuncOptions().padding_mode(torch::kBorder).align_corners(false));
}

torch::Tensor Turned(const torch::Tensor& pictures, int element) {
  const torch::Tensor flipped = element >= 4 ? pictures.flip({3}) : pictures;
  return element % 4 == 0 ? flipped : flipped.rot90(element % 4, {2, 3});
}

torch::Tensor Tinted(const torch::Tensor& pictures, const Camera& camera) {
  const torch::Tensor tint =
      torch::tensor({camera.tint[0], camera.tint[1], camera.tint[2]}, pictures.options());
  return (pictures * tint.view({1, 3, 1, 1})).clamp_max(1.0);
}

template <typename Vary>
torch::Tensor EachInItsWay(const torch::Tensor& pictures, const std::vector<int>& elements,
                           const Vary& vary) {
  torch::Tensor varied = torch::empty_like(pictures, at::MemoryFormat::Contiguous);
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const auto row = static_cast<std::int64_t>(i);
    varied.narrow(0, row, 1).copy_(vary(pictures.narrow(0, row, 1), elements[i]));
  }
  return varied;
}

}  // namespace

torch::Tensor MovedAsView(const torch::Tensor& maps, int element) {
  return element < kTurns ? Turned(maps, element) : Moved(maps, CameraOf(element));
}

torch::Tensor MovedAsView(const torch::Tensor& maps, const std::vector<int>& elements) {
  return EachInItsWay(maps, elements, [](const torch::Tensor& map, int element) {
    return MovedAsView(map, element);
  });
}

torch::Tensor View(const torch::Tensor& pictures, int element) {
  const torch::Tensor moved = MovedAsView(pictures, element);
  return element < kTurns ? moved : Tinted(moved, CameraOf(element));
}

torch::Tensor View(const torch::Tensor& pictures, const std::vector<int>& elements) {
  return EachInItsWay(pictures, elements, [](const torch::Tensor& picture, int element) {
    return View(picture, element);
  });
}

int ViewOf(const TrainConfig& config, int trial_index, int variant) {
  if (config.augment == "dihedral") return (trial_index + variant) % kTurns;
  if (config.augment != "camera" || variant == 0) return 0;
  CounterRandom random(kCameraStream, static_cast<std::uint64_t>(trial_index),
                       static_cast<std::uint64_t>(variant));
  return kTurns + static_cast<int>(random.Below(kCameras));
}

int DrawView(const TrainConfig& config, CounterRandom* random) {
  if (config.augment == "dihedral") return static_cast<int>(random->Below(kTurns));
  if (config.augment != "camera" || random->Below(2) == 0) return 0;
  return kTurns + static_cast<int>(random->Below(kCameras));
}

}  // namespace prospect::model
