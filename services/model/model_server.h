#pragma once

#include <cstdint>
#include <deque>
#include <list>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "model/engine.h"
#include "model/novelty.h"
#include "services/common/bus.h"
#include "services/common/clock.h"
#include "services/common/health.h"
#include "services/model/batch_timing.h"
#include "services/model/picture_encoder.h"
#include "services/model/request_queue.h"
#include "services/model/search_memory.h"
#include "services/model/serving_statistics.h"

namespace prospect::services {

struct ModelServerOptions {
  int batch = 16;                      ///< most rows a batch
  std::size_t cache_bytes = 64 << 20;  ///< hidden states of one search
  std::size_t queue_paths = 4096;      ///< paths that may wait before BUSY
  /// With what a search's picture is compared; none: nothing is said of it.
  std::optional<model::NoveltyGauge> novelty = {};
};

/// A model server: encodes the pictures of searches, imagines the paths that workers ask for, and
/// answers each batch with one EXPAND_REPLY that everybody hears. What has arrived when a batch
/// ends makes the next one; it waits for more only while clients just answered are due back
/// (BatchTiming). Repeated requests are answered from
/// memory; requests against the rules, for other weights or for a search whose pictures have not
/// come are refused with the reason. Several servers may stand side by side; each answers what is
/// addressed to it, or to anybody (server_id 0).
///
/// One thread: construct, then call Turn() until it is time to stop. Bus and engine must outlive
/// it.
class ModelServer {
 public:
  ModelServer(Bus& bus, model::Engine& engine, const ModelServerOptions& options);

  /// Waits for messages when there is nothing to do, then does what is due: one batch, at most one
  /// picture.
  void Turn();

  /// The last word on HEALTH.
  void Leave();

 private:
  // A search as known here. Its memory exists from the root on; it is ready when both pictures
  // came.
  struct Active {
    search_root_t root{};
    std::unique_ptr<SearchMemory> memory;
    std::map<std::int64_t, model::Hidden> pictures;  // by image id, until ready
    std::int64_t heard_ms = 0;
    std::vector<std::uint8_t> present_picture;  // x, on which imagined pictures are painted
  };

  void OnRoot(const search_root_t& root);
  void OnImage(const search_image_t& image);
  void OnStop(const search_stop_t& stop);
  void OnExpand(const expand_request_t& request);
  void OnPredict(const predict_request_t& request);

  Active* Find(std::int64_t search_id, std::int32_t epoch);
  void Admit(const search_root_t& root);
  bool Suits(const search_root_t& root) const;
  std::string Defect(const expand_request_t& request, Active* active) const;
  void Refuse(const expand_request_t& request, std::int8_t status, int retry_ms,
              const std::string& reason);
  void RunBatch();
  std::vector<planner::Path> GatherPaths(const RequestQueue::Entry& head,
                                         std::vector<double>* ages_ms);
  std::int64_t BatchWaitUs();
  double WaitMs() const;
  void ReplyTo(Active& active, const std::vector<planner::Path>& computed);
  expand_reply_t ReplyHead(const search_root_t& root) const;
  void RunPrediction();
  predict_reply_t Predict(const predict_request_t& request, Active* active);
  void AddRoot(const Active& active, const model::Hidden& state, predict_reply_t* reply);
  void PublishInfo();
  void PublishInfo(const Active* active);
  void PublishCalibrations();
  int RetryMs() const;

  Bus& bus_;
  model::Engine& engine_;
  ModelServerOptions options_;
  HealthBeacon health_;
  PictureEncoder encoder_;
  RequestQueue queue_;
  ServingStatistics statistics_;
  BatchTiming timing_;
  std::optional<task_t> task_;
  std::list<Active> searches_;  // most recently heard first
  std::set<std::int64_t> stopped_searches_;
  std::deque<predict_request_t> predictions_;
  Periodic info_due_{1000};
  std::vector<Subscription> subscriptions_;
};

}  // namespace prospect::services
