// plumbline._plumbline: what plumbline/*.py stand on. Arrays go in and out as numpy arrays, numbers are SI.
#include "python/bindings.h"
#include "simulator/trace/error.h"

namespace plumbline::python {

namespace py = pybind11;
using nlohmann::json;

py::object to_python(const json& value) {
  switch (value.type()) {
    case json::value_t::object: {
      py::dict dict;
      for (const auto& [key, item] : value.items()) {
        dict[py::str(key)] = to_python(item);
      }
      return std::move(dict);
    }
    case json::value_t::array: {
      py::list list;
      for (const json& item : value) {
        list.append(to_python(item));
      }
      return std::move(list);
    }
    case json::value_t::string: {
      const auto text = value.get<std::string>();
      if (text == "inf" || text == "-inf") {
        return py::float_(text == "inf" ? std::numeric_limits<double>::infinity()
                                        : -std::numeric_limits<double>::infinity());
      }
      return py::str(text);
    }
    case json::value_t::boolean:
      return py::bool_(value.get<bool>());
    case json::value_t::number_integer:
    case json::value_t::number_unsigned:
      return py::int_(value.get<std::int64_t>());
    case json::value_t::number_float:
      return py::float_(value.get<double>());
    default:
      return py::none();
  }
}

}  // namespace plumbline::python

PYBIND11_MODULE(_plumbline, module) {
  module.doc() = "The compiled part of plumbline.";
  module.attr("version") = PLUMBLINE_VERSION;
  pybind11::register_exception<plumbline::InputError>(module, "InputError", PyExc_ValueError);
  plumbline::python::bind_models(module);
  plumbline::python::bind_trials(module);
  plumbline::python::bind_results(module);
}
