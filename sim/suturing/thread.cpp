#include "sim/suturing/thread.h"

#include <algorithm>
#include <cmath>

namespace prospect::sim {
namespace {

using Eigen::Vector3d;

constexpr int kPoints = 20;           // of a slack strand
constexpr int kTightPoints = 6;       // of one that is pulled tight
constexpr double kLies = 0.4e-3;      // m, height of a thread that lies on the pad
constexpr double kMostSlack = 60e-3;  // m, more is out of sight

// A curve of about `length` from `from` to `to`: two legs' sag, down and to one side, on the pad
// where it would fall below it.
Strand Slack(const Vector3d& from, const Vector3d& to, double length, double side,
             int points = kPoints) {
  const Vector3d line = to - from;
  const double straight = line.norm();
  const double most = std::min(length, straight + kMostSlack);
  const double sag = 0.45 * std::sqrt(std::max(0.0, most * most - straight * straight));
  const Vector3d across = Vector3d(-line.y(), line.x(), 0).normalized() * side;
  const Vector3d fall = (0.8 * across - 0.9 * Vector3d::UnitZ()) * sag;
  const Vector3d swing = 0.35 * sag * Vector3d(line.x(), line.y(), 0).normalized();
  Strand strand;
  for (int i = 0; i < points; ++i) {
    const double s = static_cast<double>(i) / (points - 1);
    Vector3d point = from + s * line + 4 * s * (1 - s) * fall + std::sin(2 * M_PI * s) * swing;
    point.z() = std::max(point.z(), std::min({kLies, from.z(), to.z()}));
    strand.push_back(point);
  }
  return strand;
}

Vector3d OnPad(const Vector3d& point) { return {point.x(), point.y(), kLies}; }

}  // namespace

Vector3d SuturingThread::Anchor() const {
  return OnPad(passed == 0 ? end : stitches[passed - 1].exit);
}

void SuturingThread::Reach(const Vector3d& tail, const Vector3d& right, bool taut) {
  const Vector3d from = in_right ? right : Anchor();
  const double least = (tail - from).norm();
  length = taut ? least : std::max(length, least);
}

Vector3d SuturingThread::Middle(const Vector3d& tail) const {
  Strand strand = Slack(Anchor(), tail, length, side);
  return strand[strand.size() / 2];
}

std::vector<Strand> ThreadStrands(const SuturingThread& thread, const Vector3d& tail,
                                  const Vector3d& right) {
  std::vector<Strand> strands;
  Vector3d from = OnPad(thread.end);
  for (int i = 0; i < thread.passed; ++i) {
    const Vector3d to = OnPad(thread.stitches[i].entry);
    const bool last = i + 1 == thread.passed;
    strands.push_back(Slack(from, to, (to - from).norm() + (last ? thread.feed : 0.3e-3),
                            i % 2 == 0 ? -thread.side : thread.side,
                            last ? kPoints : kTightPoints));
    from = OnPad(thread.stitches[i].exit);
  }
  if (thread.in_right) {
    strands.push_back({from, right});
    from = right;
  }
  // While the tail is below the surface the thread is seen as far as to where it goes in.
  const bool below = thread.entered && tail.z() < kLies;
  const Vector3d to = below ? OnPad(thread.stitches[thread.passed].entry) : tail;
  strands.push_back(Slack(from, to, thread.length, thread.side));
  return strands;
}

}  // namespace prospect::sim
