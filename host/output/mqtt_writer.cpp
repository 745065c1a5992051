// SPDX-License-Identifier: Apache-2.0
// libmosquitto, driven by the writer's own thread: the library's would end neither in bounded time
// while it connects, nor wake for the queue, and gives up for good where TLS fails once.
#include "host/output/mqtt_writer.hpp"

#include <fmt/format.h>
#include <mosquitto.h>
#include <netdb.h>
#include <poll.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <functional>
#include <string_view>
#include <utility>

#include "host/output/estimate_writer.hpp"

namespace penduline {
namespace {

using namespace std::chrono_literals;
using std::chrono::milliseconds;

constexpr std::chrono::seconds kKeepAlive = 15s;
constexpr std::chrono::seconds kFirstBackOff = 1s;
constexpr std::chrono::seconds kLongestBackOff = 30s;
/// A connection that holds for so long was a good one.
constexpr std::chrono::seconds kSteady = 10s;
/// How often the library looks after its keep-alive.
constexpr milliseconds kLook = 1s;
/// What the library sends before the first is acknowledged; it would keep more without a bound.
constexpr std::uint64_t kInFlight = 20;
/// The retained messages are to arrive.
constexpr int kRetainedQos = 1;

constexpr std::string_view kOnline = "online";
constexpr std::string_view kOffline = "offline";

/// One for each topic, so that a broker that has not yet missed an earlier connection ends it, and
/// tells its last will, before it takes the next one. 23 characters, which every broker must take.
std::string client_id(const std::string& topic) {
  constexpr unsigned kSpareBits = 8;
  return fmt::format("penduline{:014x}", std::hash<std::string>()(topic) >> kSpareBits);
}

std::string reason_of(int code, int system_reason) {
  if (code == MOSQ_ERR_EAI) {
    return ::gai_strerror(system_reason);
  }
  return code == MOSQ_ERR_ERRNO ? std::strerror(system_reason) : mosquitto_strerror(code);
}

const char* text_or_none(const std::string& text) {
  return text.empty() ? nullptr : text.c_str();
}

}  // namespace

void MqttWriter::Destroy::operator()(mosquitto* client) const {
  mosquitto_destroy(client);
}

MqttWriter::MqttWriter(MqttAddress address, MqttOptions options)
    : address_(std::move(address)),
      options_(std::move(options)),
      estimate_topic_(address_.topic + "/estimate"),
      back_off_(kFirstBackOff) {
  static const int ready = mosquitto_lib_init();
  if (ready == MOSQ_ERR_SUCCESS) {
    client_.reset(mosquitto_new(client_id(address_.topic).c_str(), true, this));
  }
}

tl::expected<std::unique_ptr<MqttWriter>, Error> MqttWriter::make(MqttAddress address,
                                                                  MqttOptions options) {
  std::unique_ptr<MqttWriter> writer(new MqttWriter(std::move(address), std::move(options)));
  const int code = writer->client_ ? writer->set_up() : MOSQ_ERR_ERRNO;
  if (code != MOSQ_ERR_SUCCESS) {
    return failure(fmt::format("{}: {}", writer->name(), reason_of(code, errno)));
  }
  return writer;
}

int MqttWriter::set_up() {
  mosquitto* const client = client_.get();
  mosquitto_connect_callback_set(client, [](mosquitto* /*client*/, void* writer, int code) {
    static_cast<MqttWriter*>(writer)->on_answer(code);
  });
  mosquitto_publish_callback_set(client, [](mosquitto* /*client*/, void* writer, int id) {
    static_cast<MqttWriter*>(writer)->on_published(id);
  });
  int code = mosquitto_int_option(client, MOSQ_OPT_TCP_NODELAY, 1);
  if (code == MOSQ_ERR_SUCCESS && address_.tls) {
    code = mosquitto_int_option(client, MOSQ_OPT_TLS_USE_OS_CERTS, 1);
  }
  if (code == MOSQ_ERR_SUCCESS && !address_.user.empty()) {
    code =
        mosquitto_username_pw_set(client, address_.user.c_str(), text_or_none(address_.password));
  }
  if (code == MOSQ_ERR_SUCCESS) {
    code =
        mosquitto_will_set(client, (address_.topic + "/state").c_str(),
                           static_cast<int>(kOffline.size()), kOffline.data(), kRetainedQos, true);
  }
  return code;
}

tl::expected<void, Error> MqttWriter::run(EstimateQueue& queue) {
  while (link_ != Link::kLeft && !queue.expired()) {
    if (link_ != Link::kDown) {
      serve(queue);
    } else if (failed_ && queue.closed()) {
      break;
    } else if (const auto left = next_attempt_ - Clock::now(); left > 0s) {
      queue.wait(EstimateQueue::kNoFile, 0, std::chrono::ceil<milliseconds>(left));
    } else {
      connect(queue);
    }
  }
  return {};
}

void MqttWriter::connect(EstimateQueue& queue) {
  refusal_.clear();
  const int code = mosquitto_connect(client_.get(), address_.host.c_str(), address_.port,
                                     static_cast<int>(kKeepAlive.count()));
  link_ = Link::kAsking;
  if (code != MOSQ_ERR_SUCCESS) {
    lose(queue, code, errno);
  }
}

/// One round of the connection: what can be published, sent, read.
void MqttWriter::serve(EstimateQueue& queue) {
  int code = publish_what_is_due(queue);
  if (link_ == Link::kLeaving && mosquitto_socket(client_.get()) < 0) {
    link_ = Link::kLeft;
    return;
  }
  if (code == MOSQ_ERR_SUCCESS) {
    code = send_and_receive(queue);
  }
  const int reason = errno;
  queue.count_written(std::exchange(arrived_, 0));
  if (code != MOSQ_ERR_SUCCESS) {
    lose(queue, code, reason);
  }
}

/// Not from the library's callbacks: it holds mutexes then.
int MqttWriter::publish_what_is_due(EstimateQueue& queue) {
  if (link_ == Link::kAnswered) {
    link_ = Link::kUp;
    publish_retained("/rig", options_.description);
    publish_retained("/state", kOnline);
  }
  if (link_ == Link::kUp) {
    return publish_estimates(queue);
  }
  if (link_ == Link::kLeaving && !retained_.contains(farewell_)) {
    return mosquitto_disconnect(client_.get());
  }
  return MOSQ_ERR_SUCCESS;
}

int MqttWriter::send_and_receive(EstimateQueue& queue) {
  mosquitto* const client = client_.get();
  const int events = POLLIN | (mosquitto_want_write(client) ? POLLOUT : 0);
  const int ready = queue.wait(mosquitto_socket(client), static_cast<short>(events), kLook);
  int code = MOSQ_ERR_SUCCESS;
  if ((ready & ~POLLOUT) != 0) {
    code = mosquitto_loop_read(client, 1);
  }
  if (code == MOSQ_ERR_SUCCESS && (ready & POLLOUT) != 0) {
    code = mosquitto_loop_write(client, 1);
  }
  return code == MOSQ_ERR_SUCCESS ? mosquitto_loop_misc(client) : code;
}

int MqttWriter::publish_estimates(EstimateQueue& queue) {
  const bool last = queue.closed();
  int code = MOSQ_ERR_SUCCESS;
  while (code == MOSQ_ERR_SUCCESS && in_flight_ < kInFlight) {
    const auto oldest = queue.pop();
    if (!oldest) {
      break;
    }
    payload_.clear();
    append_estimate_message(payload_, oldest->estimate, oldest->unix_s);
    ++in_flight_;
    code =
        mosquitto_publish(client_.get(), nullptr, estimate_topic_.c_str(),
                          static_cast<int>(payload_.size()), payload_.data(), options_.qos, false);
  }
  if (last && in_flight_ == 0 && code == MOSQ_ERR_SUCCESS) {
    farewell_ = publish_retained("/state", kOffline);
    link_ = Link::kLeaving;
  }
  return code;
}

/// Returns the message's id. Where it does not go, the connection's next round says so.
int MqttWriter::publish_retained(const char* subtopic, std::string_view payload) {
  const std::string topic = address_.topic + subtopic;
  int id = 0;
  mosquitto_publish(client_.get(), &id, topic.c_str(), static_cast<int>(payload.size()),
                    payload.data(), kRetainedQos, true);
  retained_.insert(id);
  return id;
}

void MqttWriter::on_answer(int code) {
  if (code != 0) {
    refusal_ = mosquitto_connack_string(code);
    return;
  }
  link_ = Link::kAnswered;
  up_since_ = Clock::now();
  if (std::exchange(failed_, false)) {
    options_.warn(fmt::format("{}: the broker is there again", name()));
  }
}

void MqttWriter::on_published(int id) {
  if (retained_.erase(id) == 0) {
    --in_flight_;
    ++arrived_;
  }
}

void MqttWriter::lose(EstimateQueue& queue, int code, int reason) {
  if (link_ == Link::kUp && Clock::now() - up_since_ >= kSteady) {
    back_off_ = kFirstBackOff;
  }
  link_ = Link::kDown;
  next_attempt_ = Clock::now() + back_off_;
  back_off_ = std::min(2 * back_off_, kLongestBackOff);
  if (options_.qos == 0) {
    // The library forgets them; those of the other levels it sends again.
    in_flight_ = 0;
  }
  if (!std::exchange(failed_, true) && !queue.closed()) {
    options_.warn(fmt::format(
        "{}: no broker; it is tried again, and the newest {} estimates wait: {}", name(),
        EstimateQueue::kCapacity, refusal_.empty() ? reason_of(code, reason) : refusal_));
  }
}

}  // namespace penduline
