#include "sim/suturing/scene.h"

#include "base/random.h"

namespace prospect::sim {
namespace {

using Eigen::AngleAxisd;
using Eigen::Isometry3d;
using Eigen::Translation3d;
using Eigen::Vector3d;

constexpr std::uint64_t kSceneStream = 0x7375747572ULL;
constexpr double kMm = 1e-3;

Vector3d Jitter(double mm, base::Random* random) {
  const double x = random->Uniform(-mm, mm), y = random->Uniform(-mm, mm);
  return Vector3d(x, y, random->Uniform(-mm, mm)) * kMm;
}

Color Tint(const Color& color, double range, base::Random* random) {
  Color out = color;
  for (int i = 0; i < 3; ++i) out[i] *= static_cast<float>(1 + random->Uniform(-range, range));
  return out;
}

SuturingLook DrawLook(base::Random* random) {
  SuturingLook look;
  look.eye = Vector3d(0, -66, 92) * kMm + Jitter(3, random);
  look.target = Vector3d(0, -1, 3) * kMm + Jitter(1.5, random);
  look.fov = 0.55 + random->Uniform(-0.012, 0.012);
  look.pad = Tint(Color(0.86f, 0.60f, 0.50f), 0.06, random);
  look.cut = Tint(Color(0.42f, 0.10f, 0.09f), 0.10, random);
  look.dot = Tint(Color(0.10f, 0.09f, 0.12f), 0.10, random);
  look.table = Tint(Color(0.13f, 0.19f, 0.22f), 0.10, random);
  look.thread = Tint(Color(0.10f, 0.12f, 0.45f), 0.10, random);
  look.texture = random->Next();
  return look;
}

Isometry3d Shaken(const Isometry3d& pose, base::Random* random) {
  Isometry3d out = pose;
  out.translation() += Jitter(3, random);
  out.rotate(AngleAxisd(random->Uniform(-0.15, 0.15), Vector3d::UnitZ()));
  return out;
}

}  // namespace

SurgeonStyle StyleOf(int surgeon) {
  static constexpr SurgeonStyle kStyles[kSurgeons] = {{1.25, 1.3, 1.2},   // B
                                                      {1.05, 1.0, 1.0},   // C
                                                      {0.88, 0.7, 0.8},   // D
                                                      {0.92, 0.8, 0.8},   // E
                                                      {1.08, 1.1, 1.0},   // F
                                                      {1.30, 1.4, 1.2},   // G
                                                      {1.18, 1.3, 1.1},   // H
                                                      {1.22, 1.2, 1.2}};  // I
  return kStyles[surgeon % kSurgeons];
}

SuturingScene DrawSuturingScene(std::uint64_t seed, int surgeon, const SuturingParameters& p) {
  base::Random random(base::MixSeeds({seed, kSceneStream}));
  SuturingScene scene;
  scene.seed = seed;
  const int drawn = random.Below(kSurgeons);
  scene.style = StyleOf(surgeon < 0 ? drawn : surgeon);
  scene.light = 1 + random.Uniform(-p.light_range, p.light_range);
  scene.look = DrawLook(&random);
  for (int i = 0; i < 2; ++i) scene.hands[i] = Shaken(RestPose(i), &random);
  const Vector3d at = Vector3d(18, 5, 0) * kMm + Jitter(2.5, &random);
  scene.needle = Translation3d(at.x(), at.y(), p.wire_radius) *
                 AngleAxisd(random.Uniform(-2.4, -1.6), Vector3d::UnitZ());
  scene.thread_end = Vector3d(24, -15, 0) * kMm + Jitter(2, &random);
  scene.thread_length = random.Uniform(44, 52) * kMm;
  scene.thread_side = random.Uniform() < 0.5 ? -1 : 1;
  return scene;
}

}  // namespace prospect::sim
