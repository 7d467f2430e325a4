#include "validation/report/thin.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

namespace plumbline::validation {
namespace {

Block block_of(Eigen::Index first, Eigen::Index count, Eigen::Index points) {
  // Two points for less than three samples would be no saving.
  const Eigen::Index bucket =
      count <= points ? 1 : std::max<Eigen::Index>(3, (2 * count + points - 1) / points);
  return {first, count, bucket};
}

/// Calls use(first, count) for every bucket of a thinned block.
template <typename Use>
void for_each_bucket(const Block& block, const Use& use) {
  for (Eigen::Index k = 0; k < block.count; k += block.bucket) {
    use(block.first + k, std::min(block.bucket, block.count - k));
  }
}

/// Smallest and largest value of a bucket in the order of their samples.
std::pair<double, double> extremes(const Eigen::VectorXd& values, Eigen::Index first, Eigen::Index count) {
  Eigen::Index low = -1;
  Eigen::Index high = -1;
  for (Eigen::Index i = first; i < first + count; ++i) {
    if (std::isnan(values[i])) {
      continue;
    }
    low = low < 0 || values[i] < values[low] ? i : low;
    high = high < 0 || values[i] > values[high] ? i : high;
  }
  if (low < 0) {
    const double nothing = std::numeric_limits<double>::quiet_NaN();
    return {nothing, nothing};
  }
  return {values[std::min(low, high)], values[std::max(low, high)]};
}

Eigen::Index points_of(const std::vector<Block>& blocks) {
  Eigen::Index points = 0;
  for (const Block& block : blocks) {
    points += block.points();
  }
  return points;
}

}  // namespace

std::vector<Block> drawing_blocks(Eigen::Index samples, std::vector<Span> spans, Eigen::Index points,
                                  Eigen::Index detail) {
  std::sort(spans.begin(), spans.end(), [](const Span& a, const Span& b) { return a.first < b.first; });
  std::vector<Block> blocks;
  const auto add_between = [&](Eigen::Index from, Eigen::Index to) {
    if (to > from) {
      const auto share = static_cast<double>(to - from) / static_cast<double>(samples);
      const auto here = static_cast<Eigen::Index>(std::ceil(share * static_cast<double>(points)));
      blocks.push_back(block_of(from, to - from, here));
    }
  };
  Eigen::Index done = 0;
  for (const Span& span : spans) {
    add_between(done, span.first);
    blocks.push_back(block_of(span.first, span.count, detail));
    done = span.first + span.count;
  }
  add_between(done, samples);
  return blocks;
}

Eigen::VectorXd thinned(const Eigen::VectorXd& values, const std::vector<Block>& blocks) {
  Eigen::VectorXd out(points_of(blocks));
  Eigen::Index at = 0;
  for (const Block& block : blocks) {
    if (block.bucket == 1) {
      out.segment(at, block.count) = values.segment(block.first, block.count);
      at += block.count;
      continue;
    }
    for_each_bucket(block, [&](Eigen::Index first, Eigen::Index count) {
      std::tie(out[at], out[at + 1]) = extremes(values, first, count);
      at += 2;
    });
  }
  return out;
}

Eigen::VectorXd thinned_time(const Eigen::VectorXd& time, const std::vector<Block>& blocks) {
  Eigen::VectorXd out(points_of(blocks));
  Eigen::Index at = 0;
  for (const Block& block : blocks) {
    if (block.bucket == 1) {
      out.segment(at, block.count) = time.segment(block.first, block.count);
      at += block.count;
      continue;
    }
    for_each_bucket(block, [&](Eigen::Index first, Eigen::Index count) {
      const double from = time[first];
      const double length = time[first + count - 1] - from;
      out[at++] = from + 0.25 * length;
      out[at++] = from + 0.75 * length;
    });
  }
  return out;
}

}  // namespace plumbline::validation
