// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace femscalpel::bindings {

using IndexArray = pybind11::array_t<std::int64_t, pybind11::array::c_style | pybind11::array::forcecast>;
using RealArray = pybind11::array_t<double, pybind11::array::c_style | pybind11::array::forcecast>;

/// Read-only NumPy array on memory that belongs to the Python object `owner`, which it keeps alive.
template <class T>
pybind11::array_t<T> view(const T* data, std::vector<pybind11::ssize_t> shape, pybind11::handle owner) {
    pybind11::array_t<T> array(std::move(shape), data, owner);
    pybind11::detail::array_proxy(array.ptr())->flags &= ~pybind11::detail::npy_api::NPY_ARRAY_WRITEABLE_;
    return array;
}

/// New NumPy array with a copy of `values`.
template <class T>
pybind11::array_t<T> copied(std::span<const T> values) {
    return pybind11::array_t<T>(static_cast<pybind11::ssize_t>(values.size()), values.data());
}

/// The values of a one-dimensional array.
inline std::vector<std::int64_t> to_vector(const IndexArray& array) {
    return {array.data(), array.data() + array.size()};
}

}  // namespace femscalpel::bindings
