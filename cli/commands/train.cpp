#include "cli/commands/train.h"

#include <algorithm>

#include "cli/command.h"
#include "cli/options/common.h"
#include "cli/values.h"

namespace prospect::cli {
namespace {

struct Word {
  const char* name;
  const char* what;
};

constexpr Word kVariants[] = {
    {"naive", "one step, L1"},
    {"l1", "two linked steps, L1"},
    {"l1+0.01c", "and C's cross-entropy on the second picture, times 0.01"},
    {"l1+0.001c", "times 0.001"},
    {"no-skips", "L1+0.001C without T's skip connection"},
    {"cgan", "two linked steps, L1 and the judge of pix2pix"},
    {"wgan", "two linked steps, L1 and a Wasserstein judge, by RMSProp"},
    {"u-net", "L1+0.001C with strided convolutions for the soft argmax"},
};

constexpr Word kSteps[] = {
    {"views", "pictures turned, or as if from other cameras"},
    {"focus", "pixels that differ from the mean picture weigh more"},
    {"landmarks", "where things are is read from C, encodings and T's states"},
    {"gain", "the decoder paints all pictures in one light"},
    {"encodings", "T first learns the encodings of the goal pictures; without, pictures only"},
    {"links", "more than two transforms trained one after another"},
    {"growth", "T begins with fewer linked transforms"},
    {"actions", "every layer of T is told the action, not its bottleneck alone"},
    {"mask", "T keeps numbers of the state it began from where a mask says so"},
    {"pictures", "the picture loss of T outweighs landmarks and f"},
    {"done", "a head like f on T's states, passed on to T"},
    {"imagined", "V, Q, p and f learn on imagined states, too"},
    {"inside", "f's frames shortly before an action ends weigh less"},
    {"composing", "imagined pictures keep what was seen where nothing changes"},
};

// A paragraph below the options, a line a word.
template <std::size_t N>
std::string Listed(std::string title, const Word (&words)[N]) {
  for (const Word& word : words) {
    std::string name = word.name;
    name.resize(std::max<std::size_t>(name.size(), 10), ' ');
    title += "\n  " + name + "  " + word.what;
  }
  return title + "\n";
}

template <std::size_t N>
std::vector<std::string> NamesOf(const Word (&words)[N]) {
  std::vector<std::string> names;
  for (const Word& word : words) names.push_back(word.name);
  return names;
}

// What changes the task's own configuration.
void DefineConfiguration(CLI::App& app, TrainOptions& options) {
  app.add_option("--iterations", options.iterations,
                 "iterations of the transform network; the other stages scale with it")
      ->type_name("N")
      ->transform(Whole(1, 1'000'000'000));
  app.add_option(
         "--minutes", options.minutes,
         "as many iterations as fit into this time, by each stage's measured speed; reading "
         "data and scoring come on top")
      ->type_name("M")
      ->check(Real(0.01, 100'000))
      ->excludes(app.get_option("--iterations"));
  app.add_option("--variant", options.variant, "a row of the paper's comparison; see below")
      ->type_name("NAME")
      ->check(OneOf(VariantNames()));
  app.add_flag("--paper", options.paper,
               "leave all steps beyond the paper out; T is updated as often");
  app.add_option("--without", options.without,
                 "leave these steps beyond the paper out, where the task takes them; see below")
      ->type_name("NAMES")
      ->delimiter(',')
      ->check(OneOf(RecipeStepNames()));
  app.add_flag("--finetune", options.finetune,
               "let encoder and decoder learn on with the transform network");
  app.add_option("--seed", options.seed, "of first weights, batches and dropout")
      ->type_name("N")
      ->transform(Whole(0, 999'999'999'999'999'999));
  app.add_option("--config", options.config,
                 "JSON with what to change of the configuration (see --print-config)")
      ->type_name("FILE");
  app.add_option("--precision", options.precision,
                 "float32; mixed: convolutions in 16-bit bfloat, faster on CUDA and on processors "
                 "with AVX512-BF16; auto: mixed on such processors")
      ->type_name("NAME")
      ->check(OneOf({"float32", "mixed", "auto"}));
  app.add_option("--labels", options.labels,
                 "what V, Q, p and f are taught: paper, or authors: as their code does it")
      ->type_name("NAME")
      ->check(OneOf({"paper", "authors"}));
  app.add_flag("--print-config", options.print_config, "print the configuration and stop");
}

// Where a run begins and what of it is done.
void DefineRun(CLI::App& app, TrainOptions& options) {
  app.add_option("--device", options.device, "what computes")
      ->type_name("NAME")
      ->check(OneOf({"cpu", "cuda"}))
      ->capture_default_str();
  DefineThreads(app, options.threads);
  app.add_option("--from", options.from, "begin from these weights")->type_name("FILE");
  app.add_option("--fresh", options.fresh,
                 "with --from: networks of these stages (as of --stage) begin from random weights "
                 "all the same")
      ->type_name("NAMES")
      ->delimiter(',');
  app.add_option(
         "--stage", options.stages,
         "only these stages: classifier, second-classifier, encoder-decoder, transform, heads")
      ->type_name("NAMES");
  app.add_option("--score", options.score,
                 "train nothing: score this weights file, and the classifiers' file beside it, on "
                 "the data's held-out trials")
      ->type_name("FILE");
  app.add_option("--bundle", options.bundle,
                 "copy the weights into this folder, too, without C, which only training needs")
      ->type_name("DIR");
}

// All that a recipe says itself is not to be said beside it.
void DefineRecipe(CLI::App& app, TrainOptions& options) {
  CLI::Option* recipe =
      app.add_option("--recipe", options.recipe,
                     "train all runs of this file, such as recipes/stacking.json, which made the "
                     "bundled weights, one after the other, each in a folder of its name in --out")
          ->type_name("FILE");
  for (const char* name : {"--task", "--minutes", "--variant", "--paper", "--without", "--finetune",
                           "--config", "--labels", "--from", "--fresh", "--stage", "--score"}) {
    recipe->excludes(app.get_option(name));
  }
}

// A run of a sweep may say all that one that is typed may.
void DefineSweep(CLI::App& app, TrainOptions& options) {
  CLI::Option* sweep =
      app.add_option("--sweep", options.sweep,
                     "a list of runs (YAML), each a map of these options without dashes, and a "
                     "name: train run --index of it, in a folder of its name in --out")
          ->type_name("FILE")
          ->excludes(app.get_option("--recipe"));
  CLI::Option* index = app.add_option("--index", options.index, "which run of --sweep, from 1")
                           ->type_name("I")
                           ->transform(Whole(1, 1'000'000))
                           ->needs(sweep);
  sweep->needs(index);
  app.parse_complete_callback([&app, &options] {
    options.asked = Given(app, [](const std::string& name) {
      return name != "--sweep" && name != "--index" && name != "--out" && name != "--json" &&
             name != "--quiet" && name != "--help";
    });
  });
}

}  // namespace

std::vector<std::string> VariantNames() { return NamesOf(kVariants); }
std::vector<std::string> RecipeStepNames() { return NamesOf(kSteps); }

void Define(CLI::App& app, TrainOptions& options) {
  DefineTask(app, options.task, Tasks::kAll);
  app.add_option("--data", options.data, "data set made by collect (HDF5)")->type_name("FILE");
  DefineOut(app, options.out,
            "folder for checkpoints and caches; weights and curves.csv go there, too, with "
            "--variant into a folder of that name inside");
  DefineConfiguration(app, options);
  DefineRun(app, options);
  DefineRecipe(app, options);
  DefineSweep(app, options);
  DefineReport(app, options.report);
  app.footer(Listed("Rows of the paper's comparison (--variant):", kVariants) + "\n" +
             Listed("Steps beyond the paper (--without):", kSteps));
}

std::string Defect(const TrainOptions& options) {
  const bool lacks = options.data.empty() || options.out.empty();
  return lacks && !options.print_config ? "--data and --out are required" : "";
}

}  // namespace prospect::cli
