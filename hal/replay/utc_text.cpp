// SPDX-License-Identifier: Apache-2.0
// From microseconds to a date and back.
#include "hal/replay/utc_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

namespace penduline {
namespace {

using std::chrono::microseconds;
using std::chrono::sys_days;

/// What four digits of a year can say.
constexpr sys_days kFirstDay{std::chrono::year{1970} / 1 / 1};
constexpr sys_days kDayAfterLast{std::chrono::year{10000} / 1 / 1};

}  // namespace

std::string utc_text_s(std::int64_t utc_us) {
  const microseconds since_1970(std::clamp(
      utc_us, std::int64_t{0}, microseconds(kDayAfterLast.time_since_epoch()).count() - 1));
  const auto days = std::chrono::floor<std::chrono::days>(since_1970);
  const std::chrono::year_month_day date{kFirstDay + days};
  const std::chrono::hh_mm_ss time{std::chrono::floor<std::chrono::seconds>(since_1970 - days)};
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}Z", int{date.year()},
                     unsigned{date.month()}, unsigned{date.day()}, time.hours().count(),
                     time.minutes().count(), time.seconds().count());
}

std::string utc_text(std::int64_t utc_us) {
  constexpr std::int64_t kUsPerSecond = 1'000'000;
  std::string text = utc_text_s(utc_us);
  text.pop_back();
  return text + fmt::format(".{:06}Z", std::max(utc_us, std::int64_t{0}) % kUsPerSecond);
}

std::int64_t utc_us_of(const toml::date_time& time) {
  const sys_days day{std::chrono::year{static_cast<int>(time.date.year)} /
                     static_cast<int>(time.date.month) / static_cast<int>(time.date.day)};
  const auto since_midnight =
      std::chrono::hours(time.time.hour) + std::chrono::minutes(time.time.minute) +
      std::chrono::seconds(time.time.second) +
      std::chrono::floor<microseconds>(std::chrono::nanoseconds(time.time.nanosecond));
  const std::chrono::minutes ahead_of_utc(time.offset ? time.offset->minutes : 0);
  return (microseconds(day.time_since_epoch()) + since_midnight - ahead_of_utc).count();
}

}  // namespace penduline
