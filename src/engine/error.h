// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <stdexcept>
#include <string>

namespace femscalpel {

/// Base of every error the engine raises. The message names the file, line, entity or parameter at
/// fault and says what the user can do.
class Error : public std::runtime_error {
public:
    /// `parameter` is a literal: the name of the parameter of the function or constructor called that is at fault, as
    /// the Python package calls it; "" when it is none or not one alone.
    explicit Error(const std::string& message, const char* parameter = "")
        : std::runtime_error(message), parameter_(parameter) {}

    /// Name of the parameter that the error is about, or "".
    const char* parameter() const noexcept { return parameter_; }

private:
    const char* parameter_;
};

/// A file cannot be read: missing, truncated, corrupt, or it contradicts itself.
class ReadError : public Error {
public:
    using Error::Error;
};

/// A file cannot be written, or its format cannot hold the mesh.
class WriteError : public Error {
public:
    using Error::Error;
};

/// A tool or an option is unusable (zero normal, bad name, tool misses the mesh).
class ToolError : public Error {
public:
    using Error::Error;
};

/// No valid mesh of acceptable shape can be made this way.
class QualityError : public Error {
public:
    using Error::Error;
};

/// The tool or its band reaches elements the method cannot cut (quadrangles, prisms, ...).
class UnsupportedElementError : public Error {
public:
    using Error::Error;
};

}  // namespace femscalpel
