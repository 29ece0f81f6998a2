#pragma once

#include "cli/commands/bench.h"
#include "cli/commands/console.h"
#include "cli/commands/deployment.h"
#include "cli/commands/evaluate.h"
#include "cli/commands/merge.h"
#include "cli/commands/tasks.h"
#include "cli/commands/upkeep.h"
#include "cli/run/invocation.h"

/// The commands that `prospect` itself carries out: what each starts, and how. Implemented one file
/// a command or group of commands.
namespace prospect::cli {

Words ProgramsOf(const DemoOptions& options);
int Run(const DemoOptions& options, const Invocation& invocation);

Words ProgramsOf(const ExplainOptions& options);
int Run(const ExplainOptions& options, const Invocation& invocation);

Words ProgramsOf(const UpOptions& options);
int Run(const UpOptions& options, const Invocation& invocation);

Words ProgramsOf(const RunOptions& options);
int Run(const RunOptions& options, const Invocation& invocation);

Words ProgramsOf(const DownOptions& options);
int Run(const DownOptions& options, const Invocation& invocation);

Words ProgramsOf(const KeyOptions& options);
int Run(const KeyOptions& options, const Invocation& invocation);

Words ProgramsOf(const ScaleOptions& options);
int Run(const ScaleOptions& options, const Invocation& invocation);

Words ProgramsOf(const ConsoleOptions& options);
int Run(const ConsoleOptions& options, const Invocation& invocation);

Words ProgramsOf(const StatusOptions& options);
int Run(const StatusOptions& options, const Invocation& invocation);

Words ProgramsOf(const CheckRobotOptions& options);
int Run(const CheckRobotOptions& options, const Invocation& invocation);

Words ProgramsOf(const EvaluateOnBusOptions& options);
int Run(const EvaluateOnBusOptions& options, const Invocation& invocation);

Words ProgramsOf(const PredictOptions& options);
int Run(const PredictOptions& options, const Invocation& invocation);

Words ProgramsOf(const SpyOptions& options);
int Run(const SpyOptions& options, const Invocation& invocation);

Words ProgramsOf(const BenchSearchOptions& options);
int Run(const BenchSearchOptions& options, const Invocation& invocation);

Words ProgramsOf(const MergeOptions& options);
int Run(const MergeOptions& options, const Invocation& invocation);

Words ProgramsOf(const TaskLearnOptions& options);
int Run(const TaskLearnOptions& options, const Invocation& invocation);

int Run(const TasksOptions& options);
int Run(const RecordOptions& options);
int Run(const DoctorOptions& options);

int TellMessages();
int TellVersion();
int TellCompletion();

}  // namespace prospect::cli
