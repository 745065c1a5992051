// SPDX-License-Identifier: Apache-2.0
// Proof that the pipeline and the wire take no memory from the heap: every operator new is counted.
#include <array>
#include <atomic>
#include <catch2/catch.hpp>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <new>
#include <span>
#include <tuple>

#include "common/pipeline.hpp"
#include "common/swing_tracker.hpp"
#include "common/wire/decoder.hpp"
#include "common/wire/rig_image.hpp"
#include "tests/unit/common/simulated_swing.hpp"
#include "tests/unit/common/test_rig.hpp"

namespace {

std::atomic<long> allocations = 0;

void* counted_or_null(std::size_t size) {
  ++allocations;
  return std::malloc(size > 0 ? size : 1);
}

void* counted(std::size_t size) {
  void* memory = counted_or_null(size);
  if (memory == nullptr) {
    throw std::bad_alloc();
  }
  return memory;
}

void* counted(std::size_t size, std::align_val_t alignment) {
  ++allocations;
  const auto bytes = static_cast<std::size_t>(alignment);
  void* memory = std::aligned_alloc(bytes, (size + bytes - 1) / bytes * bytes);
  if (memory == nullptr) {
    throw std::bad_alloc();
  }
  return memory;
}

}  // namespace

// Every form, since a sanitizer brings those of its own that are left out.
void* operator new(std::size_t size) {
  return counted(size);
}
void* operator new[](std::size_t size) {
  return counted(size);
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  return counted(size, alignment);
}
void* operator new[](std::size_t size, std::align_val_t alignment) {
  return counted(size, alignment);
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  return counted_or_null(size);
}
void* operator new[](std::size_t size, const std::nothrow_t&) noexcept {
  return counted_or_null(size);
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete[](void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
void operator delete[](void* memory, std::size_t) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept {
  std::free(memory);
}
void operator delete[](void* memory, std::align_val_t) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  std::free(memory);
}
void operator delete[](void* memory, std::size_t, std::align_val_t) noexcept {
  std::free(memory);
}

namespace penduline::test {
namespace {

/// How many allocations a piece of work makes.
template <class Work>
long allocations_in(const Work& work) {
  const long before = allocations;
  work();
  return allocations - before;
}

/// Every kind of response, a sensor of each, and faults of every kind among the samples.
template <class Scalar>
void run_pipeline() {
  constexpr std::array<Scalar, 3> kVolts = {Scalar(0.3), Scalar(1), Scalar(3)};
  constexpr std::array<Scalar, 3> kGaps = {Scalar(0.03), Scalar(0.025), Scalar(0.01)};
  Rig<Scalar> rig = linear_rig(three_sensor_layout<Scalar>());
  rig.responses[1].model = TableResponse<Scalar>{MonotoneCubic<Scalar>(kVolts, kGaps)};
  rig.responses[2].model =
      PolynomialResponse<Scalar>{{Scalar(0.031), Scalar(-0.006)}, 2, 0, Scalar(3.3)};
  Pipeline<Scalar> pipeline(rig, Acquisition<Scalar>{.sensor_count = 3});
  const auto gap_m = gaps_at(widened(rig.layout), {from_degrees(5), from_degrees(-3)});
  int answers = 0;
  for (std::uint64_t seq = 0; seq < 100; seq += seq == 70 ? 2 : 1) {
    Sample sample = sample_of(seq, gap_m);
    sample.missing = seq == 30 ? 1 : 0;
    sample.flags = seq == 50 ? flag::kSaturated : 0;
    answers += pipeline.update(sample).attitude.has_value() ? 1 : 0;
  }
  if (answers == 0) {
    std::abort();
  }
}

/// The Kalman filter over a swing with a dropout, a kick and a stray reading.
template <class Scalar>
void run_tracker() {
  SimulatedSwing swing(1, start_of(1));
  SwingTracker<Scalar> tracker(noisy_rig<Scalar>(), {});
  for (int i = 0; i < 200; ++i) {
    if (i == 100) {
      swing.lose();
      swing.kick(0.6, -0.4);
    }
    Sample sample = swing.next();
    sample.readings[0].on += i == 50 ? 3000 : 0;
    if (!tracker.update(sample).attitude) {
      std::abort();
    }
  }
}

TEST_CASE("The count sees an allocation of every form", "[no_heap]") {
  // Called by name, since the compiler may leave out a new-expression.
  const std::align_val_t line{64};
  CHECK(allocations_in([] { ::operator delete(::operator new(1)); }) == 1);
  CHECK(allocations_in([] { ::operator delete[](::operator new[](1)); }) == 1);
  CHECK(allocations_in([] { ::operator delete(::operator new(1, std::nothrow)); }) == 1);
  CHECK(allocations_in([&] { ::operator delete(::operator new(1, line), line); }) == 1);
  CHECK(allocations_in([&] { ::operator delete[](::operator new[](1, line), line); }) == 1);
}

TEMPLATE_TEST_CASE("Making a pipeline and running it allocates nothing", "[no_heap]", float,
                   double) {
  CHECK(allocations_in(run_pipeline<TestType>) == 0);
}

TEMPLATE_TEST_CASE("The Kalman filter allocates nothing", "[no_heap]", float, double) {
  CHECK(allocations_in(run_tracker<TestType>) == 0);
}

/// Every message there and back, and a rig's image.
void run_wire() {
  std::array<std::uint8_t, wire::kMaxFrameBytes> frame{};
  wire::Decoder decoder;
  std::size_t read = 0;
  wire::for_each_message([&]<wire::Message Kind>(const Kind& message) {
    const std::size_t size = wire::encode_frame(message, frame);
    decoder.push(std::span(frame).first(size), [&](const wire::Frame& found) {
      read += wire::read_message<Kind>(found.payload) ? 1U : 0U;
    });
  });
  std::array<std::uint8_t, wire::kMaxRigImageBytes> image{};
  const std::size_t size =
      wire::encode_rig({.rig = linear_rig(three_sensor_layout<float>())}, image);
  if (read != std::tuple_size_v<wire::AllMessages> ||
      !wire::decode_rig(std::span(image).first(size))) {
    std::abort();
  }
}

TEST_CASE("Sending and receiving allocates nothing", "[no_heap]") {
  CHECK(allocations_in(run_wire) == 0);
}

}  // namespace
}  // namespace penduline::test
