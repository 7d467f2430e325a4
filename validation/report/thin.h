// Fewer points for drawing, with nothing that sticks out lost.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace plumbline::validation {

/// Samples first ... first + count - 1. bucket 1: every one of them is drawn. Otherwise each `bucket` samples
/// (the last ones may be fewer) become two points: their smallest and largest value, in the order in which
/// they occur.
struct Block {
  Eigen::Index first = 0, count = 0, bucket = 1;

  Eigen::Index points() const { return bucket == 1 ? count : 2 * ((count + bucket - 1) / bucket); }
};

/// Samples first ... first + count - 1 that are wanted in detail.
struct Span {
  Eigen::Index first = 0, count = 0;
};

/// Blocks that cover `samples` samples without a gap: about `points` points over the whole, and in each of
/// the spans every sample, or `detail` points where it has more. Spans may touch but not overlap.
std::vector<Block> drawing_blocks(Eigen::Index samples, std::vector<Span> spans, Eigen::Index points,
                                  Eigen::Index detail);

/// The points of all blocks. NaN (nothing was predicted) counts only where a bucket holds nothing else.
Eigen::VectorXd thinned(const Eigen::VectorXd& values, const std::vector<Block>& blocks);

/// Where the points stand: a bucket's two points at a quarter and three quarters of it, the same for every
/// channel, so that all of them share one axis.
Eigen::VectorXd thinned_time(const Eigen::VectorXd& time, const std::vector<Block>& blocks);

}  // namespace plumbline::validation
