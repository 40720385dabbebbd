// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/time_spread.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>
#include <vector>

#include "tradeoff/prediction_interval.h"

namespace weft::time_spread_test {
namespace {

using Times = std::vector<double>;

std::vector<TradeoffPoint> points_of(const std::vector<Times>& times) {
    std::vector<TradeoffPoint> points(times.size());
    for (std::size_t i = 0; i < times.size(); ++i) points[i].runs_ms = times[i];
    return points;
}

TimeSpread spread_of(const std::vector<Times>& times) {
    return time_spread(points_of(times));
}

bool within(const Interval& interval, double value) {
    return value >= interval.low && value <= interval.high;
}

TEST(TimeSpread, TwoTimesOfOneSettingGiveAClosedForm) {
    // Each is a factor of 2 from the other, and t is that of one degree of freedom.
    const TimeSpread spread = spread_of({{2.0, 4.0}});
    const double t = std::tan(0.95 * std::numbers::pi / 2.0);
    EXPECT_DOUBLE_EQ(spread.degrees, 1.0);
    EXPECT_EQ(spread.deviations, 2U);
    EXPECT_NEAR(std::log(spread.factor), t * std::log(2.0), 1e-10);
    const Interval interval = time_interval(Times{2.0, 4.0}, spread);
    EXPECT_DOUBLE_EQ(interval.median, 3.0);
    EXPECT_DOUBLE_EQ(interval.low, 3.0 / spread.factor);
    EXPECT_DOUBLE_EQ(interval.high, 3.0 * spread.factor);
}

/// 60 settings of two times, the first `far` of which differ by a factor of e and the others by
/// almost nothing; every other one was slower first, so that rounds are alike.
std::vector<Times> with_far(std::size_t far) {
    std::vector<Times> times;
    for (std::size_t i = 0; i < 60; ++i) {
        const double ratio = i < far ? std::numbers::e : 1.0 + 1e-6;
        times.push_back(i % 2 == 0 ? Times{7.0, 7.0 * ratio} : Times{7.0 * ratio, 7.0});
    }
    return times;
}

TEST(TimeSpread, FarTimesCountByTheirShare) {
    // Of 120 deviations, the 115th by size is the least that keeps to 95 % of 121: that of the
    // third largest pair.
    EXPECT_NEAR(std::log(spread_of(with_far(4)).factor), 1.0, 1e-12);
    EXPECT_NEAR(std::log(spread_of(with_far(3)).factor), 1.0, 1e-12);
    // t is below 2.01 from 50 degrees of freedom on, and what lies far out no farther than 1e-6.
    EXPECT_LT(std::log(spread_of(with_far(2)).factor), 2.01e-6);
    EXPECT_GT(std::log(spread_of(with_far(2)).factor), 0.99e-6);
}

TEST(TimeSpread, ASlowRoundLeavesFewDegreesOfFreedom) {
    std::mt19937_64 random(3);
    std::normal_distribution<double> noise(0.0, 0.01);
    std::vector<Times> apart;
    std::vector<Times> together;
    for (std::size_t i = 0; i < 10; ++i) {
        Times times;
        for (std::size_t round = 0; round < 5; ++round)
            times.push_back(100.0 * std::exp(noise(random)));
        apart.push_back(times);
        together.push_back(times);
        apart.back()[i % 5] *= 1.5;
        together.back()[2] *= 1.5;
    }
    const TimeSpread scattered = spread_of(apart);
    const TimeSpread drifted = spread_of(together);
    // Nearly all of it is in the five rounds, which leave four, or in none of them.
    EXPECT_NEAR(drifted.degrees, 4.0, 0.2);
    EXPECT_GT(scattered.degrees, 30.0);
    EXPECT_GT(scattered.factor, 1.45);
    // 0.182 is log(1.5) / sqrt(5); t of four degrees of freedom is 2.78, of three 3.18.
    EXPECT_GT(std::log(drifted.factor), 2.7 * 0.182);
    EXPECT_LT(std::log(drifted.factor), 3.3 * 0.182);
}

TEST(TimeSpread, EqualTimesHaveAnIntervalWithoutWidth) {
    const TimeSpread spread = spread_of({{0.3, 0.3, 0.3}, {1e9, 1e9, 1e9}});
    EXPECT_EQ(spread.factor, 1.0);
    EXPECT_EQ(spread.deviations, 6U);
    const Interval interval = time_interval(Times{0.3, 0.3, 0.3}, spread);
    EXPECT_EQ(interval.low, 0.3);
    EXPECT_EQ(interval.median, 0.3);
    EXPECT_EQ(interval.high, 0.3);
}

TEST(TimeSpread, IsTheSameInEveryUnitAndOrderOfSettings) {
    const std::vector<Times> times{{3.0, 4.0, 3.5}, {90.0, 70.0, 75.0}, {11.0, 10.0, 16.0}};
    std::vector<Times> others{times[2], times[0], times[1]};
    for (Times& setting : others)
        for (double& time : setting) time *= 1024.0;
    const double factor = spread_of(times).factor;
    EXPECT_GT(factor, 1.1);
    EXPECT_NEAR(spread_of(others).factor, factor, 1e-12 * factor);
}

TEST(TimeSpread, ATimeOfZeroHasNoRatio) {
    const std::vector<Times> times{{3.0, 4.0, 3.5}, {90.0, 70.0, 75.0}};
    std::vector<Times> with_zero = times;
    const Times zeros{0.0, 2.0, 1.0};
    with_zero.push_back(zeros);
    const TimeSpread spread = spread_of(with_zero);
    EXPECT_EQ(spread.deviations, 6U);
    EXPECT_EQ(spread.factor, spread_of(times).factor);
    const Interval alone = prediction_interval(zeros);
    const Interval interval = time_interval(zeros, spread);
    EXPECT_EQ(interval.low, 0.0);
    EXPECT_EQ(interval.high, alone.high);
    const TimeSpread none = spread_of({{0.0, 0.0}});
    EXPECT_EQ(none.deviations, 0U);
    EXPECT_EQ(none.factor, 1.0);
    EXPECT_EQ(time_interval(Times{0.0, 0.0}, none).high, 0.0);
}

TEST(TimeSpread, OfNothingIsNone) {
    EXPECT_EQ(time_spread({}).deviations, 0U);
    // Without a spread, times have what they show themselves.
    const Times times{2.0, 4.0};
    EXPECT_EQ(time_interval(times, {}).high, prediction_interval(times).high);
}

TEST(TimeSpread, NeedsTwoTimesOfEachThatAreNumbers) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    EXPECT_THROW((void)spread_of({{1.0}}), std::invalid_argument);
    EXPECT_THROW((void)spread_of({{}}), std::invalid_argument);
    EXPECT_THROW((void)spread_of({{1.0, 2.0}, {1.0, 2.0, 3.0}}), std::invalid_argument);
    EXPECT_THROW((void)time_interval(Times{1.0}, {}), std::invalid_argument);
    for (const double bad : {std::nan(""), infinity, -1.0}) {
        EXPECT_THROW((void)spread_of({{1.0, 2.0}, {1.0, bad}}), std::invalid_argument) << bad;
        EXPECT_THROW((void)time_interval(Times{1.0, bad}, {}), std::invalid_argument) << bad;
    }
}

TEST(TimeSpread, EndsAreFiniteHoweverFarTimesLieApart) {
    const Times times{1e-300, 1e300};
    const TimeSpread spread = spread_of({times, {5e-324, 1e308}});
    EXPECT_TRUE(std::isfinite(spread.factor));
    const Interval interval = time_interval(times, spread);
    EXPECT_TRUE(std::isfinite(interval.high));
    EXPECT_GE(interval.high, interval.median);
    EXPECT_GE(interval.low, 0.0);
}

TEST(TimeSpread, ASettingThatScattersMoreThanOthersIsTakenByItself) {
    const TimeSpread spread{.factor = 1.2, .degrees = 40.0, .deviations = 50};
    const Times erratic{50.0, 100.0, 200.0, 100.0, 105.0};
    EXPECT_EQ(time_interval(erratic, spread).high, prediction_interval(erratic).high);
    EXPECT_EQ(time_interval(erratic, spread).low, prediction_interval(erratic).low);
    // One that is far off may be any setting's.
    const Times struck{100.0, 100.0, 200.0, 101.0, 99.0};
    EXPECT_DOUBLE_EQ(time_interval(struck, spread).high, 120.0);
}

/// A machine that renders settings in turn, and takes times of a known distribution.
struct Machine {
    std::size_t settings;
    std::size_t rounds;
    double noise;        ///< standard deviation of logarithms
    double spikes;       ///< share of times that are 1.3 to 2.5 times as long
    double drift;        ///< standard deviation of what changes slowly
    double drift_turns;  ///< images after which it has changed by most
};

class Simulation {
  public:
    Simulation(const Machine& machine, std::uint64_t seed) : machine_(machine), random_(seed) {}

    /// Logarithm of one time, relative to its setting's; the machine wanders on.
    double next() {
        const double kept = std::exp(-1.0 / machine_.drift_turns);
        state_ = kept * state_ + std::sqrt(1.0 - kept * kept) * normal_(random_);
        double value = machine_.drift * state_ + machine_.noise * normal_(random_);
        if (uniform_(random_) < machine_.spikes) value += std::log(1.3 + 1.2 * uniform_(random_));
        return value;
    }
    /// At some other time.
    void leave() { state_ = normal_(random_); }
    std::size_t any(std::size_t count) {
        return std::uniform_int_distribution<std::size_t>(0, count - 1)(random_);
    }

  private:
    Machine machine_;
    std::mt19937_64 random_;
    std::normal_distribution<double> normal_;
    std::uniform_real_distribution<double> uniform_;
    double state_ = 0.0;
};

/// Half of the width, in logarithms, of the interval that leaves 2.5 % of all times on either side:
/// what the distribution itself would give.
double oracle_reach(const Machine& machine) {
    constexpr std::size_t count = 200000;
    Simulation simulation(machine, 11);
    Times values;
    for (std::size_t i = 0; i < count; ++i) {
        simulation.leave();
        values.push_back(simulation.next());
    }
    std::sort(values.begin(), values.end());
    return 0.5 * (values[count - count / 40] - values[count / 40]);
}

struct Outcome {
    double share = 0.0;      ///< of trials whose one fresh time lies within
    double reach = 0.0;      ///< mean of the logarithm of the ends' ratio, halved
    double own_reach = 0.0;  ///< the same of intervals by a setting's own times
};

double reach_of(const Interval& interval) {
    return 0.5 * std::log(interval.high / interval.low);
}

/// Trials of a sweep each, and one image of one setting within a sweep's time after it: trials
/// are independent.
Outcome simulate(const Machine& machine, int trials) {
    Simulation simulation(machine, 20261123);
    Outcome outcome;
    for (int trial = 0; trial < trials; ++trial) {
        simulation.leave();
        std::vector<Times> times(machine.settings);
        for (std::size_t round = 0; round < machine.rounds; ++round)
            for (std::size_t i = 0; i < machine.settings; ++i)
                times[i].push_back(10.0 * std::exp(simulation.next() + static_cast<double>(i)));
        const TimeSpread spread = spread_of(times);
        const std::size_t chosen = simulation.any(machine.settings);
        for (std::size_t wait = simulation.any(machine.settings * machine.rounds); wait > 0; --wait)
            (void)simulation.next();
        const double fresh = 10.0 * std::exp(simulation.next() + static_cast<double>(chosen));
        const Interval interval = time_interval(times[chosen], spread);
        outcome.share += within(interval, fresh) ? 1.0 / trials : 0.0;
        outcome.reach += reach_of(interval) / trials;
        outcome.own_reach += reach_of(prediction_interval(times[chosen])) / trials;
    }
    return outcome;
}

/// Four standard deviations below a share of so many trials: less than one seed in ten thousand
/// puts it above the probability.
double surely_at_least(double share, int trials) {
    return share - 4.0 * std::sqrt(share * (1.0 - share) / trials);
}

constexpr std::array machines{
    Machine{10, 5, 0.1, 0.0, 0.0, 1.0},      // nothing but noise
    Machine{10, 5, 0.08, 0.03, 0.06, 8.0},   // all three
    Machine{10, 5, 0.08, 0.08, 0.03, 8.0},   // many spikes
    Machine{10, 5, 0.04, 0.02, 0.12, 10.0},  // drift before all, about a round long
    Machine{10, 3, 0.08, 0.03, 0.06, 8.0},   // as --quick
    Machine{50, 5, 0.08, 0.03, 0.06, 40.0},  // all settings
};

TEST(TimeSpread, HoldsAFreshTimeOfAMachineThatWandersAndStumbles) {
    constexpr int trials = 3000;
    for (const Machine& machine : machines) {
        const Outcome outcome = simulate(machine, trials);
        const std::size_t number = static_cast<std::size_t>(&machine - machines.data());
        EXPECT_GE(surely_at_least(outcome.share, trials), 0.9) << number << ": " << outcome.share;
        // Five times of ten settings do not tell all of their distribution: on average, the reach
        // is at most half as long again as by the distribution itself, with three at most twice.
        const double most = machine.rounds == 3 ? 2.0 : 1.5;
        EXPECT_LE(outcome.reach, most * oracle_reach(machine)) << number;
        // Of plain noise they tell more than one setting's own five. With spikes, its own are
        // narrower where they were spared, and wrong.
        if (machine.spikes == 0.0) {
            EXPECT_LT(outcome.reach, 0.9 * outcome.own_reach) << number;
        }
    }
}

TEST(TimeSpread, FewSettingsAreWideRatherThanWrong) {
    constexpr int trials = 3000;
    for (const Machine& machine :
         {Machine{1, 5, 0.1, 0.0, 0.0, 1.0}, Machine{1, 2, 0.1, 0.0, 0.0, 1.0},
          Machine{3, 3, 0.08, 0.03, 0.06, 4.0}})
        EXPECT_GE(surely_at_least(simulate(machine, trials).share, trials), 0.9)
            << machine.settings << " " << machine.rounds;
}

TEST(TimeSpread, ASimulationCanFail) {
    // Drift much slower than the sweep is not in it: what intervals cannot know, they do not hold.
    const Machine machine{10, 5, 0.02, 0.0, 0.2, 1000.0};
    EXPECT_LT(simulate(machine, 1000).share, 0.9);
}

}  // namespace
}  // namespace weft::time_spread_test
