// SPDX-License-Identifier: Apache-2.0
// GPIO lines in memory: outputs that note what they were set to, inputs that say what a test has
// written down.
#pragma once

#include <algorithm>
#include <chrono>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "hal/linux/gpio.hpp"

namespace penduline::test {

/// What became of one output; may be looked at while a thread drives it.
class Wire {
 public:
  struct Change {
    bool active = false;
    std::chrono::steady_clock::time_point at{};
  };

  void set(bool active) {
    const std::lock_guard lock(mutex_);
    changes_.push_back({active, std::chrono::steady_clock::now()});
  }
  [[nodiscard]] std::vector<Change> changes() const {
    const std::lock_guard lock(mutex_);
    return changes_;
  }
  [[nodiscard]] std::vector<bool> levels() const {
    std::vector<bool> levels;
    for (const Change& change : changes()) {
      levels.push_back(change.active);
    }
    return levels;
  }

  bool broken = false;  ///< set fails
  GpioDrive drive{};    ///< as it was opened

 private:
  mutable std::mutex mutex_;
  std::vector<Change> changes_;
};

class ScriptedOutput final : public GpioOutput {
 public:
  ScriptedOutput(std::shared_ptr<Wire> wire, bool active) : wire_(std::move(wire)) {
    wire_->set(active);
  }
  ScriptedOutput(const ScriptedOutput&) = delete;
  ScriptedOutput& operator=(const ScriptedOutput&) = delete;
  ~ScriptedOutput() override { wire_->set(false); }

  tl::expected<void, Error> set(bool active) override {
    if (wire_->broken) {
      return failure("GPIO line 'W': No such device");
    }
    wire_->set(active);
    return {};
  }

 private:
  std::shared_ptr<Wire> wire_;
};

/// Hands on its edges one batch a call; then there are none, or it fails.
class ScriptedInput final : public GpioInput {
 public:
  explicit ScriptedInput(std::vector<GpioEdges> batches, bool fails_then = false)
      : batches_(std::move(batches)), fails_then_(fails_then) {}

  tl::expected<GpioEdges, Error> wait(std::chrono::milliseconds /*patience*/) override {
    if (next_ < batches_.size()) {
      return batches_[next_++];
    }
    if (fails_then_) {
      return failure("GPIO line 'TRIGGER': No such device");
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return GpioEdges{};
  }

 private:
  std::vector<GpioEdges> batches_;
  std::size_t next_ = 0;
  bool fails_then_;
};

/// A machine's lines. Those that a test does not name are there and work.
class ScriptedGpio final : public Gpio {
 public:
  tl::expected<std::unique_ptr<GpioOutput>, Error> open_output(const GpioLine& line,
                                                               GpioDrive drive,
                                                               bool active) override {
    if (!admit(line.name)) {
      return failure("no " + line.name);
    }
    wire(line.name)->drive = drive;
    return std::make_unique<ScriptedOutput>(wire(line.name), active);
  }
  tl::expected<std::unique_ptr<GpioInput>, Error> open_input(const GpioLine& line) override {
    if (!admit(line.name)) {
      return failure("no " + line.name);
    }
    return std::make_unique<ScriptedInput>(edges);
  }

  std::shared_ptr<Wire> wire(const std::string& name) {
    for (const auto& [known, wire] : wires_) {
      if (known == name) {
        return wire;
      }
    }
    return wires_.emplace_back(name, std::make_shared<Wire>()).second;
  }

  std::vector<std::string> opened;  ///< in their order
  std::string missing;              ///< cannot be had
  std::vector<GpioEdges> edges;     ///< of the input

 private:
  bool admit(const std::string& name) {
    opened.push_back(name);
    return name != missing;
  }

  std::vector<std::pair<std::string, std::shared_ptr<Wire>>> wires_;
};

}  // namespace penduline::test
