// The one exception for bad input: a message a user can act on.
#pragma once

#include <stdexcept>
#include <string>

namespace diptych::core {

/// Bad usage or bad input. `what()` is one line that names the file, the object in it and the reason. It names a setting
/// by its name in the library, between backticks: "`look_at`". A front end writes its own word there, such as an option.
class Error : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// The machine lacks a device that the task needs; `what()` lists what is missing.
class NoDevice : public Error {
public:
    using Error::Error;
};

/// A device without room for what the task needs. `what()` says what was asked for, what is there, and what would fit.
class OutOfMemory : public Error {
public:
    using Error::Error;
};

/// A device that fell away while it worked: what stands on it is lost, and another may be opened.
class DeviceLost : public Error {
public:
    using Error::Error;
};

}  // namespace diptych::core
