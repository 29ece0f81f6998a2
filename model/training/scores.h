#pragma once

#include <nlohmann/json.hpp>

#include "model/training/context.h"

namespace prospect::model {

/// Held-out scores of trained networks (in inference mode, weights already rounded as they are
/// stored). Thresholds are chosen on validation trials (0.5 where there are none), everything is
/// reported on test trials. Keys:
///
// clang-format off
///   trials, chains        test trials; chains of actions the pictures are scored on
///   pictures.x1, .x2      after one and two transforms from the start of actions, each with
///     mae, mae_changed      against the goal picture as seen (with noise); "changed": pixels that
///                           differ by more than 0.1 between the clean start and goal pictures
///     mae_clean, mae_changed_clean  against the clean goal picture
///     copy_*                the same four for copying the start picture x (the trivial answer)
///     reconstruction_*      the same four for decode(encode(goal)): the best T could reach
///     psnr, ssim            means over pictures of the peak signal-to-noise ratio in dB and of the
///                           structural similarity (picture_measures.h), against the noisy goal;
///                           copy_*, reconstruction_* as above
///     noise_floor           clean against noisy goal: nothing can do better on `mae`
///     samples
///   labels.x1, .x2        of actions that succeeded: share of predicted pictures with the right label
///     second, first         by the second classifier and by C itself,
///     real_second, real_first  of the real goal pictures by both,
///     majority              and by always answering the most frequent action;
///     samples
///   value, f, p, q        what V, f, p, Q say, each of
///     .real                 pictures between actions, f also of pictures inside them
///     .boundary, .boundary_after_one, .boundary_after_two
///                           pictures between actions only, and one and two transforms of them
///     .after_one, .after_two, .imagined
///                           one, two, any number of transforms of a trial's first picture;
///                           f also .depth1, ...
///   plan                  V at the end of an imagined trial times f along the way. All of these have
///     balanced_accuracy, threshold  at the threshold that is best on validation trials
///     balanced_accuracy_at_half     at 0.5
///     accuracy, area_under_roc, base_rate, brier, trivial_brier, samples
///     recall_at_tenth       p only: share of actions taken next with p above 0.1, the paper's measure
///     (the trivial balanced accuracy and ROC area are 0.5)
// clang-format on
///
/// Uses `threads` threads. Throws DataError if the test part is empty.
nlohmann::json ComputeScores(const TrainContext& context, const TrialFile& file, int threads);

/// The table a person reads, to stdout.
void PrintScores(const nlohmann::json& scores);

/// Rounds all weights to 16-bit floats and back, so that scores are those of the stored file.
void RoundToHalf(const Networks& networks);

}  // namespace prospect::model
