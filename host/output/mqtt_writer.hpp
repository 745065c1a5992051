// SPDX-License-Identifier: Apache-2.0
// Publishes queued estimates on an MQTT broker, which may be away.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <tl/expected.hpp>

#include "host/output/output_address.hpp"
#include "host/output/queued_output.hpp"

struct mosquitto;

namespace penduline {

struct MqttOptions {
  int qos = 0;              ///< of the estimates: 0 to 2
  std::string description;  ///< of the rig, as JSON
  /// Told from the writer's thread, once each time, that the broker is away and that it is back.
  std::function<void(const std::string&)> warn;
};

/// TOPIC/estimate has each estimate; TOPIC/rig the rig's description and TOPIC/state "online" or
/// "offline", both retained.
class MqttWriter final : public QueueWriter {
 public:
  /// Fails where the library refuses the topic, the user or TLS. Does not connect yet.
  static tl::expected<std::unique_ptr<MqttWriter>, Error> make(MqttAddress address,
                                                               MqttOptions options);

  [[nodiscard]] std::string name() const override { return address_.name; }
  /// Connects, and again as often as the broker goes, at longer and longer intervals; never fails.
  /// Estimates wait in the queue meanwhile. Looking the broker's name up and connecting may block.
  tl::expected<void, Error> run(EstimateQueue& queue) override;

 private:
  using Clock = EstimateQueue::Clock;
  enum class Link {
    kDown,      ///< not connected
    kAsking,    ///< connected, the broker has not yet answered
    kAnswered,  ///< the broker takes messages, but has none yet
    kUp,        ///< the broker has been greeted
    kLeaving,   ///< the farewell is on its way
    kLeft,
  };

  struct Destroy {
    void operator()(mosquitto* client) const;
  };

  MqttWriter(MqttAddress address, MqttOptions options);
  int set_up();
  void connect(EstimateQueue& queue);
  void serve(EstimateQueue& queue);
  int publish_what_is_due(EstimateQueue& queue);
  int publish_estimates(EstimateQueue& queue);
  int publish_retained(const char* subtopic, std::string_view payload);
  int send_and_receive(EstimateQueue& queue);
  void lose(EstimateQueue& queue, int code, int reason);
  void on_answer(int code);
  void on_published(int id);

  MqttAddress address_;
  MqttOptions options_;
  std::string estimate_topic_;
  std::unique_ptr<mosquitto, Destroy> client_;
  Link link_ = Link::kDown;
  bool failed_ = false;  ///< and has not been up since
  Clock::time_point up_since_;
  Clock::time_point next_attempt_;
  std::chrono::seconds back_off_;
  std::string refusal_;          ///< of the broker, in words
  std::uint64_t in_flight_ = 0;  ///< estimates that the library has
  std::uint64_t arrived_ = 0;    ///< estimates that went out or are acknowledged, not yet counted
  std::set<int> retained_;       ///< ids of the retained messages that are not yet acknowledged
  int farewell_ = 0;             ///< id of the last one
  std::string payload_;
};

}  // namespace penduline
