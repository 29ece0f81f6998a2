#include "sim/suturing/phases.h"

#include <cmath>

#include "sim/suturing/gestures.h"
#include "sim/suturing/needle.h"

namespace prospect::sim {
namespace {

using Eigen::AngleAxisd;
using Eigen::Isometry3d;
using Eigen::Translation3d;
using Eigen::Vector3d;

constexpr double kMm = 1e-3;
constexpr double kPace = 1.12;        // brings a trial to about two minutes
constexpr double kBackOff = 8 * kMm;  // from which jaws approach what they grip

Vector3d Mm(double x, double y, double z) { return Vector3d(x, y, z) * kMm; }

// The pose of jaws that may be turned half about their axis, whichever is closer to `now`.
Isometry3d Nearer(const Isometry3d& pose, const Isometry3d& now) {
  const Isometry3d other = pose * AngleAxisd(M_PI, Vector3d::UnitZ());
  const auto turn = [&now](const Isometry3d& to) {
    return std::abs(AngleAxisd(to.linear() * now.linear().transpose()).angle());
  };
  return turn(other) < turn(pose) ? other : pose;
}

Isometry3d BackedOff(const Isometry3d& hand, double way = kBackOff) {
  return hand * Translation3d(0, 0, -way);
}

// Fills in one phase. Hands that are not told otherwise stay where they are.
class Maker {
 public:
  Maker(const Situation& situation, const SuturingParameters& p, const SurgeonStyle& style,
        base::Random random)
      : s_(situation), p_(p), style_(style), random_(random) {
    for (int i = 0; i < 2; ++i) {
      HandMove& move = phase_.hands[i];
      move.from = move.to = s_.last[i].to;
      move.opening = s_.last[i].opening;
    }
  }

  int throws() const { return std::min(s_.suture.throws(), p_.throws - 1); }
  double throw_y() const { return EntryDot(p_, throws()).y(); }
  const Situation& situation() const { return s_; }

  Maker& For(double seconds) {
    phase_.seconds = kPace * seconds * style_.pace * (1 + p_.time_noise * random_.BoundedNormal());
    return *this;
  }

  // A free hand goes to `pose`, about.
  Maker& Move(int hand, const Isometry3d& pose) {
    GoTo(hand, Disturbed(pose));
    return *this;
  }

  Maker& Back(int hand, double way = kBackOff) {
    return Move(hand, BackedOff(s_.last[hand].to, way));
  }

  // The hand brings the needle to `needle`, about; nothing if it does not hold it.
  Maker& Carry(int hand, const Isometry3d& needle) {
    if (s_.world.holder() != hand) return *this;
    GoTo(hand, Disturbed(needle) * InHand(hand).inverse());
    return *this;
  }

  // The same, exactly but for what the tip may be off its dot.
  Maker& Aim(int hand, const Isometry3d& needle) {
    if (s_.world.holder() != hand) return *this;
    const bool bad = random_.Uniform() < p_.bad_bite;
    const double size = bad ? p_.bad_bite_size : p_.bite_noise * style_.noise;
    // One draw a statement: compilers differ in which argument of a call they evaluate first.
    const double y = size * random_.BoundedNormal();
    const double x = size * random_.BoundedNormal();
    const Vector3d off(x, y, 0);
    GoTo(hand, Translation3d(off) * needle * InHand(hand).inverse());
    return *this;
  }

  // The hand turns with the needle it holds about the needle's centre until the tip is at `angle`
  // of the circle on which it is driven.
  Maker& Drive(int hand, double angle) {
    if (s_.world.holder() != hand) return *this;
    HandMove& move = phase_.hands[hand];
    const Isometry3d needle = move.from * InHand(hand);
    const Vector3d tip = Upright({0, 0, 0}, 0).linear().transpose() * needle.linear().col(0);
    double left = angle - std::atan2(tip.y(), tip.x());
    while (left > 0) left -= 2 * M_PI;
    while (left < -2 * M_PI) left += 2 * M_PI;
    move.circular = true;
    move.center = needle.translation();
    move.axis = needle.linear().col(2);
    move.angle = left;
    return *this;
  }

  // Jaws go about the wire at `angle` of the needle as it will be; `away` before it.
  Maker& Reach(int hand, const Isometry3d& needle, double angle, double away) {
    const bool bad = away == 0 && random_.Uniform() < p_.bad_grip;
    const double size = bad ? p_.bad_grip_size : p_.grip_noise * style_.noise;
    const Isometry3d grip =
        needle * GripAt(p_, angle + size / p_.needle_radius * random_.BoundedNormal());
    const Isometry3d beside = Translation3d(0, 0, bad ? p_.bad_grip_size : 0) * grip;
    GoTo(hand, BackedOff(Nearer(beside, s_.world.hand(hand)), away));
    return *this;
  }

  Maker& Jaws(int hand, double opening) {
    phase_.hands[hand].opening = opening;
    return *this;
  }
  Maker& Open(int hand) { return Jaws(hand, p_.jaw_open); }
  Maker& Close(int hand) { return Jaws(hand, p_.jaw_closed); }

  Phase Then(PhaseEvent event, ThreadRule thread = ThreadRule::kKeep) {
    phase_.event = event;
    phase_.thread = thread;
    return phase_;
  }
  Phase Then(ThreadRule thread = ThreadRule::kKeep) { return Then(PhaseEvent::kNone, thread); }

  // The needle with its tip at `angle` as when it is driven, but centred at `center`.
  Isometry3d Upright(const Vector3d& center, double angle) const {
    Isometry3d pose = DrivePose(p_, 0, angle);
    pose.translation() = center;
    return pose;
  }

  Isometry3d Driven(double angle) const { return DrivePose(p_, throws(), angle); }

 private:
  Isometry3d InHand(int hand) const { return s_.world.hand(hand).inverse() * s_.world.needle(); }

  Vector3d Scatter(double size) {
    const double x = random_.BoundedNormal(), y = random_.BoundedNormal();
    return size * Vector3d(x, y, random_.BoundedNormal());
  }

  Isometry3d Disturbed(const Isometry3d& pose) {
    const Vector3d turn = Scatter(p_.turn_noise * style_.noise);
    Isometry3d out = pose;
    out.translation() += Scatter(p_.end_noise * style_.noise);
    if (turn.norm() > 0) out.linear() = AngleAxisd(turn.norm(), turn.normalized()) * out.linear();
    return out;
  }

  // A long way wanders more than a short one, and rather upwards than into the pad.
  void GoTo(int hand, const Isometry3d& pose) {
    HandMove& move = phase_.hands[hand];
    move.to = pose;
    const double way = (pose.translation() - move.from.translation()).norm();
    const double size = p_.wander * style_.wander * std::min(1.0, way / (20 * kMm));
    move.early_bend = Scatter(size);
    move.late_bend = Scatter(size);
    move.early_bend.z() = std::abs(move.early_bend.z());
    move.late_bend.z() = std::abs(move.late_bend.z());
  }

  const Situation& s_;
  const SuturingParameters& p_;
  const SurgeonStyle& style_;
  base::Random random_;
  Phase phase_;
};

using Planned = std::optional<Phase>;

double Degrees(double degrees) { return degrees * M_PI / 180; }

// Where the left hand waits for the needle's tip.
Isometry3d Waiting(const Maker& m) {
  return HandPose(Mm(-17, 0, 8) + Vector3d(0, m.throw_y() - 3 * kMm, 0), {0.45, 0.75, -0.5});
}

Planned ReachForNeedle(int index, Maker m, const SuturingParameters& p) {
  const Isometry3d needle = m.situation().world.needle();
  switch (index) {
    case 0:
      m.Reach(kRightHand, needle, p.right_grip, kBackOff).Open(kRightHand);
      return m.Move(kLeftHand, RestPose(kLeftHand)).For(1.9).Then();
    case 1:
      return m.Reach(kRightHand, needle, p.right_grip, 0).For(0.8).Then();
    case 2:
      return m.Close(kRightHand).For(0.4).Then(PhaseEvent::kRightTakes);
    case 3:
      return m.Carry(kRightHand, Translation3d(Mm(0, 0, 10)) * needle).For(0.9).Then();
    default:
      return {};
  }
}

Planned MoveToCenter(int index, Maker m) {
  if (index > 0) return {};
  m.Move(kLeftHand, HandPose(Mm(-22, -10, 10), {0.5, 0.65, -0.57})).Jaws(kLeftHand, 0.3);
  return m.Carry(kRightHand, m.Upright(Mm(10, 2, 20), Degrees(-60))).For(2.3).Then();
}

// Left takes the needle, right lets go and grips it anew where it should.
Planned Orient(int index, Maker m, const SuturingParameters& p) {
  const Isometry3d needle = m.situation().world.needle();
  const double left = Degrees(55);
  const Isometry3d place = m.Upright(Mm(2, -14, 20), Degrees(-100));
  switch (index) {
    case 0:
      m.Move(kLeftHand, HandPose(Mm(-14, -18, 16), {0.6, 0.7, -0.4})).Open(kLeftHand);
      return m.Carry(kRightHand, place).For(2.0).Then();
    case 1:
      return m.Reach(kLeftHand, needle, left, 0).For(0.8).Then();
    case 2:
      return m.Close(kLeftHand).For(0.4).Then(PhaseEvent::kLeftTakes);
    case 3:
      return m.Open(kRightHand).Back(kRightHand, 5 * kMm).For(0.7).Then();
    case 4:
      m.Carry(kLeftHand, m.Upright(Mm(2, -14, 20), Degrees(-75)));
      return m.Reach(kRightHand, m.Upright(Mm(2, -14, 20), Degrees(-75)), p.right_grip, 4 * kMm)
          .For(0.9)
          .Then();
    case 5:
      return m.Reach(kRightHand, needle, p.right_grip, 0).For(0.6).Then();
    case 6:
      return m.Close(kRightHand).For(0.4).Then(PhaseEvent::kRightTakes);
    case 7:
      return m.Open(kLeftHand).Back(kLeftHand, 6 * kMm).For(0.8).Then();
    default:
      return {};
  }
}

Planned Position(int index, Maker m, const SuturingParameters& p) {
  switch (index) {
    case 0:
      m.Move(kLeftHand, Waiting(m)).Open(kLeftHand);
      return m.Carry(kRightHand, Translation3d(Mm(4, 0, 7)) * m.Driven(EntryAngle(p) + 0.3))
          .For(2.4)
          .Then();
    case 1:
      return m.Aim(kRightHand, m.Driven(EntryAngle(p) + 0.05)).For(1.8).Then();
    default:
      return {};
  }
}

Planned Push(int index, Maker m, const SuturingParameters& p) {
  const Isometry3d needle = m.situation().world.needle();
  const double left = p.left_grip;
  switch (index) {
    case 0:
      return m.For(0.3).Then(PhaseEvent::kEnters);
    case 1:
      m.Move(kLeftHand, Waiting(m)).Open(kLeftHand);
      return m.Drive(kRightHand, ExitAngle(p) - p.emerge).For(5.0).Then();
    case 2:
      return m.Reach(kLeftHand, needle, left, 0).For(1.1).Then();
    case 3:
      return m.Close(kLeftHand).For(0.4).Then(PhaseEvent::kLeftTakes);
    case 4:
      return m.Open(kRightHand).Back(kRightHand, 4 * kMm).For(0.5).Then();
    case 5:
      return m.Move(kRightHand, HandPose(Mm(19, m.throw_y() / kMm - 9, 11), {-0.5, 0.7, -0.5}))
          .For(1.0)
          .Then();
    default:
      return {};
  }
}

Planned PullLeft(int index, Maker m, const SuturingParameters& p) {
  if (!m.situation().began_in_tissue) ++index;  // nothing to draw out
  switch (index) {
    case 0:
      return m.Drive(kLeftHand, ExitAngle(p) - M_PI).For(2.6).Then(PhaseEvent::kPasses);
    case 1:
      m.Move(kRightHand, RestPose(kRightHand)).Close(kRightHand);
      return m.Carry(kLeftHand, m.Upright(Mm(-23, 14, 18), Degrees(235)))
          .For(2.6)
          .Then(ThreadRule::kTighten);
    default:
      return {};
  }
}

Planned Transfer(int index, Maker m, const SuturingParameters& p) {
  const Isometry3d needle = m.situation().world.needle();
  const Isometry3d place = m.Upright(Mm(0, 10, 20), Degrees(158));
  switch (index) {
    case 0:
      m.Reach(kRightHand, place, p.right_grip, kBackOff).Open(kRightHand);
      return m.Carry(kLeftHand, place).For(2.4).Then();
    case 1:
      return m.Reach(kRightHand, needle, p.right_grip, 0).For(0.9).Then();
    case 2:
      return m.Close(kRightHand).For(0.4).Then(PhaseEvent::kRightTakes);
    case 3:
      return m.Open(kLeftHand).Back(kLeftHand, 7 * kMm).For(0.9).Then();
    default:
      return {};
  }
}

// The right hand takes the thread half way; then both go where the gesture ends.
Planned WithThread(int index, Maker m, bool tighten) {
  const SuturingThread& thread = m.situation().suture.thread;
  const Vector3d tail = m.situation().world.needle() * Vector3d(-9 * kMm, 0, 0);
  const Isometry3d taking = HandPose(thread.Middle(tail) + Mm(0, 0, 1), {-0.6, 0.6, -0.5});
  const ThreadRule rule = tighten ? ThreadRule::kTighten : ThreadRule::kLoosen;
  switch (index) {
    case 0:
      return m.Move(kRightHand, taking).Open(kRightHand).For(2.0).Then();
    case 1:
      return m.Close(kRightHand).For(0.4).Then(PhaseEvent::kRightTakesThread);
    case 2:
      m.Move(kRightHand, tighten ? HandPose(Mm(21, 8, 14), {-0.7, 0.5, -0.5})
                                 : HandPose(Mm(8, -14, 9), {-0.5, 0.7, -0.5}));
      m.Carry(kLeftHand, tighten ? m.Upright(Mm(-21, 3, 15), Degrees(235))
                                 : m.Upright(Mm(-14, -6, 14), Degrees(235)));
      return m.For(2.4).Then(rule);
    default:
      return {};
  }
}

Planned Drop(int index, Maker m, const SuturingParameters&) {
  switch (index) {
    case 0:
      m.Move(kRightHand, HandPose(Mm(22, -15, 13), {-0.4, 0.6, -0.7})).Close(kRightHand);
      return m.Carry(kLeftHand, m.Upright(Mm(-20, 6, 8), Degrees(80))).For(2.2).Then();
    case 1:
      return m.Open(kLeftHand).For(0.4).Then(PhaseEvent::kLetGo);
    case 2:
      return m.Back(kLeftHand, 6 * kMm).For(0.7).Then();
    case 3:
      m.Move(kLeftHand, HandPose(Mm(-22, -15, 13), {0.4, 0.6, -0.7})).Jaws(kLeftHand, 0);
      return m.Jaws(kRightHand, 0).For(1.6).Then();
    default:
      return {};
  }
}

}  // namespace

Isometry3d HandPose(const Vector3d& at, const Vector3d& tool) {
  const Vector3d z = tool.normalized();
  const Vector3d x = z.cross(Vector3d::UnitZ()).normalized();
  Isometry3d pose = Isometry3d::Identity();
  pose.linear() << x, z.cross(x), z;
  pose.translation() = at;
  return pose;
}

Isometry3d RestPose(int hand) {
  const double side = hand == kRightHand ? 1 : -1;
  return HandPose(Mm(side * 21, -9, 11), {-0.5 * side, 0.65, -0.57});
}

std::optional<Phase> PlanPhase(int gesture, int index, const Situation& situation,
                               const SuturingParameters& p, const SurgeonStyle& style,
                               base::Random random) {
  const Maker m(situation, p, style, random);
  switch (gesture) {
    case kReachRight:
      return ReachForNeedle(index, m, p);
    case kPosition:
      return Position(index, m, p);
    case kPush:
      return Push(index, m, p);
    case kTransfer:
      return Transfer(index, m, p);
    case kCenter:
      return MoveToCenter(index, m);
    case kPullLeft:
      return PullLeft(index, m, p);
    case kOrient:
      return Orient(index, m, p);
    case kTighten:
      return WithThread(index, m, true);
    case kLoosen:
      return WithThread(index, m, false);
    case kDrop:
      return Drop(index, m, p);
    default:
      return {};
  }
}

}  // namespace prospect::sim
