#include "sim/shift.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <stdexcept>

#include "sim/camera.h"
#include "sim/rollout.h"
#include "sim/task_factory.h"

namespace prospect::sim {
namespace {

constexpr std::uint64_t kScene = 1'400'300;  // tuning scenes: never in a reported figure

TaskOptions Shifted(const std::string& factor, int strength) {
  TaskOptions options;
  SetShift(factor, strength, &options);
  return options;
}

double MeanBrightness(const Image& image) {
  return std::accumulate(image.rgb.begin(), image.rgb.end(), 0.0) /
         static_cast<double>(image.rgb.size());
}

double MeanDifference(const Image& a, const Image& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.rgb.size(); ++i) sum += std::abs(a.rgb[i] - b.rgb[i]);
  return sum / static_cast<double>(a.rgb.size());
}

// What the physics of an episode came to, to the last bit, and what it was judged to be.
struct Course {
  std::vector<std::vector<double>> states;
  std::vector<std::string> ends;
  std::string version;
};

bool operator==(const Course& a, const Course& b) {
  return a.states == b.states && a.ends == b.ends && a.version == b.version;
}

// The first legal action each time, with a picture taken after every one.
Course Follow(const std::string& name, const TaskOptions& options) {
  const auto task = MakeTask(name, options);
  Course course;
  course.version = task->spec().world_version;
  for (std::uint64_t seed = kScene; seed < kScene + 3; ++seed) {
    task->Reset(seed);
    while (task->progress().outcome == Outcome::kRunning) {
      task->Observe();
      RunAction(*task, task->LegalActions().front(), nullptr);
      course.states.push_back(task->RobotState());
      course.states.push_back({task->progress().time, task->light()});
    }
    course.ends.push_back(task->progress().reason);
    for (const std::string& fact : task->Facts()) course.ends.push_back(fact);
  }
  return course;
}

TEST(Shift, LeavesPhysicsAndVerdictsBitIdentical) {
  for (const std::string& name : TaskNames()) {
    if (name != "navigation" && name != "stacking") continue;
    const Course plain = Follow(name, {});
    EXPECT_GT(plain.states.size(), 6u);
    for (const std::string& factor : ShiftFactors()) {
      EXPECT_TRUE(Follow(name, Shifted(factor, kShiftStrengths)) == plain) << name << ' ' << factor;
    }
  }
}

TEST(Shift, StrengthNoneLeavesPicturesBitIdentical) {
  for (const char* name : {"navigation", "stacking"}) {
    const auto plain = MakeTask(name);
    plain->Reset(kScene);
    for (const std::string& factor : ShiftFactors()) {
      const TaskOptions options = Shifted(factor, 0);
      EXPECT_EQ(options.image_noise, TaskOptions{}.image_noise);
      const auto task = MakeTask(name, options);
      task->Reset(kScene);
      EXPECT_EQ(task->Observe().rgb, plain->Observe().rgb) << name << ' ' << factor;
    }
  }
}

TEST(Shift, PicturesDifferMoreTheStrongerItIs) {
  for (const char* name : {"navigation", "stacking"}) {
    const auto plain = MakeTask(name);
    plain->Reset(kScene);
    const Image seen = plain->Observe();
    for (const char* factor : {"light", "camera", "colour"}) {
      double before = 0;
      for (int strength : {1, 3, 5}) {
        const auto task = MakeTask(name, Shifted(factor, strength));
        task->Reset(kScene);
        const double difference = MeanDifference(task->Observe(), seen);
        EXPECT_GT(difference, before) << name << ' ' << factor << ' ' << strength;
        before = difference;
      }
    }
  }
}

TEST(Shift, LightScalesBrightnessAndNoiseIsTheSensors) {
  for (const char* name : {"navigation", "stacking"}) {
    const auto plain = MakeTask(name);
    plain->Reset(kScene);
    const double usual = MeanBrightness(plain->Observe());
    const auto dim = MakeTask(name, Shifted("light", 3));
    dim->Reset(kScene);
    const double amount = ShiftAmount("light", 3);
    EXPECT_NEAR(MeanBrightness(dim->Observe()), amount * usual, 1.0) << name;
  }
  EXPECT_EQ(Shifted("noise", 4).image_noise, ShiftAmount("noise", 4));
}

// A red spot where the camera looks, on blue ground: it stays in the middle, and looks narrower.
TEST(Shift, ATiltedCameraStillLooksAtItsPoint) {
  const auto spot = [](double x, double y) {
    return std::hypot(x, y) < 1 ? Color(1, 0, 0) : Color(0, 0, 1);
  };
  const auto red_columns = [&](double tilt) {
    AerialCamera camera(AerialView{12, 3.84, tilt}, spot, {}, {});
    const Image image = camera.Render({}, 1.0, 64, 64);
    std::vector<int> columns;
    for (int x = 0; x < 64; ++x) {
      if (image.rgb[static_cast<std::size_t>(32 * 64 + x) * 3] > 127) columns.push_back(x);
    }
    return columns;
  };
  const std::vector<int> straight = red_columns(0), aslant = red_columns(0.7);
  ASSERT_GT(aslant.size(), 8u);
  EXPECT_NEAR(straight.front() + straight.back(), 63, 1);
  EXPECT_NEAR(aslant.front() + aslant.back(), 63, 2);
  EXPECT_NEAR(static_cast<double>(aslant.size()), std::cos(0.7) * straight.size(), 2);
  EXPECT_THROW(red_columns(0.8), std::invalid_argument);
}

TEST(Shift, TurnedHue) {
  const Color red(0.8f, 0.1f, 0.1f), grey(0.4f, 0.4f, 0.4f);
  const auto expect = [](const Color& got, const Color& wanted) {
    EXPECT_LT((got - wanted).cwiseAbs().maxCoeff(), 1e-5f) << got.transpose();
  };
  expect(TurnedHue(red, 60), {0.8f, 0.8f, 0.1f});
  expect(TurnedHue(red, 120), {0.1f, 0.8f, 0.1f});
  expect(TurnedHue(red, 240), {0.1f, 0.1f, 0.8f});
  expect(TurnedHue(red, 30), {0.8f, 0.45f, 0.1f});
  expect(TurnedHue({0.1f, 0.1f, 0.8f}, 120), red);
  expect(TurnedHue({0.8f, 0.1f, 0.3f}, 360), {0.8f, 0.1f, 0.3f});
  EXPECT_EQ(TurnedHue(grey, 77), grey);
  EXPECT_EQ(TurnedHue(red, 0), red);
}

TEST(Shift, UnknownFactorsAndStrengthsAreNamed) {
  TaskOptions options;
  EXPECT_THROW(SetShift("wind", 1, &options), std::invalid_argument);
  EXPECT_THROW(SetShift("wind", 0, &options), std::invalid_argument);
  EXPECT_THROW(SetShift("light", kShiftStrengths + 1, &options), std::invalid_argument);
  EXPECT_THROW(SetShift("light", -1, &options), std::invalid_argument);
  EXPECT_EQ(options.shift.light, 1);
  EXPECT_NE(ShiftText("camera", 2).find("degrees"), std::string::npos);
}

}  // namespace
}  // namespace prospect::sim
