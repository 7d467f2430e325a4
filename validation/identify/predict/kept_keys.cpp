#include "validation/identify/predict/kept_keys.h"

namespace plumbline::validation {
namespace {

void add_scores(const Scores& scores, Record& record) {
  record.add(scores.train).add(scores.held_out).add(scores.test);
}

Scores scores_from(RecordReader& reader) {
  Scores scores;
  scores.train = reader.number();
  scores.held_out = reader.number();
  scores.test = reader.number();
  return scores;
}

void add_id(const model::ParameterId& id, Record& record) { record.add(id.effect).add(id.parameter); }

}  // namespace

ResultKey key_of(const std::string& what, const model::Model& model, const Data& data) {
  ResultKey key{what + '\n'};
  for (const model::EffectUse& use : model.effects) {
    key.words += use.law->declaration().name + '@' + use.at + '\n';
    for (const double value : use.numbers()) {
      key.numbers.add(value);
    }
  }
  const PredictOptions& predict = data.predict;
  key.numbers.add(predict.relative_tolerance).add(predict.history).add(predict.most_steps);
  key.numbers.add(static_cast<double>(predict.method)).add(predict.differences ? 1.0 : 0.0);
  for (const Window& window : data.windows) {
    key.numbers.add(window.trial).add(static_cast<double>(window.first));
    key.numbers.add(static_cast<double>(window.count)).add(static_cast<double>(window.events.size()));
    key.numbers.add(window.continues ? 1.0 : 0.0);
  }
  return key;
}

void add_parameters(const std::vector<FreeParameter>& parameters, ResultKey& key) {
  for (const FreeParameter& one : parameters) {
    add_id(one.id, key.numbers);
    key.numbers.add(static_cast<double>(one.scale)).add(one.lower).add(one.upper);
    key.numbers.add(one.typical).add(one.mean).add(one.deviation);
    for (const model::ParameterId& id : one.also) {
      add_id(id, key.numbers);
    }
  }
  key.numbers.add(Eigen::VectorXd(known_correlation(parameters).reshaped()));
}

Record kept(const Data& data, const ResultKey& key, const std::function<Record()>& compute) {
  return data.kept ? data.kept->get(key, compute) : compute();
}

Record record_of(const Estimate& estimate) {
  Record record;
  record.add(estimate.theta).add(estimate.x0).add(estimate.square);
  add_scores(estimate.scores, record);
  record.add(estimate.predicted.theta).add(estimate.predicted.square);
  add_scores(estimate.predicted.scores, record);
  record.add(estimate.cost).add(estimate.iterations).add(estimate.converged ? 1.0 : 0.0);
  return record;
}

Estimate estimate_from(const Record& record) {
  RecordReader reader(record);
  Estimate estimate;
  estimate.theta = reader.vector();
  estimate.x0 = reader.vectors();
  estimate.square = reader.vectors();
  estimate.scores = scores_from(reader);
  estimate.predicted.theta = reader.vector();
  estimate.predicted.square = reader.vectors();
  estimate.predicted.scores = scores_from(reader);
  estimate.cost = reader.number();
  estimate.iterations = static_cast<int>(reader.number());
  estimate.converged = reader.number() != 0.0;
  return estimate;
}

}  // namespace plumbline::validation
