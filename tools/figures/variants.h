#pragma once

#include <string>
#include <vector>

#include "report/page.h"
#include "tools/figures/held_out.h"
#include "tools/figures/loaded_model.h"
#include "tools/figures/task_table.h"

namespace prospect::figures {

/// Trained models of one task, side by side.
struct VariantSet {
  struct Member {
    std::string name;  ///< as the paper's tables write it
    LoadedModel loaded;
  };
  std::vector<Member> trained;
  std::vector<std::string> absent;  ///< names without a weights file
};

/// Loads FOLDER/NAME/TASK.safetensors for each name of model/training/variants.h, in its order.
/// Throws model::WeightsError for a file that is there and unsound.
VariantSet LoadVariants(const std::string& folder, const std::string& task, int threads);

/// Two actions in a row of one trial: segments `first` and `first` + 1.
struct Chain {
  SeenTrial trial;
  int first = 0;
};

/// `count` chains from held-out trials in an order that `seed` decides, a trial each; their first
/// actions differ as far as that goes.
std::vector<Chain> ChooseChains(const HeldOut& held_out, const TaskTable& table, int count,
                                std::uint64_t seed);

/// variants.png: what each model imagines for the same pictures and actions, beside what the
/// camera then saw, with the mean absolute error.
/// @param own the model of --weights, the last column @param own_name its heading
report::Page DrawVariants(const std::vector<Chain>& chains, const TaskTable& table,
                          const VariantSet& variants, const LoadedModel& own,
                          const std::string& own_name);

}  // namespace prospect::figures
