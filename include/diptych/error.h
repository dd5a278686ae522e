// The library's exceptions.
#pragma once

#include <stdexcept>
#include <string>

#include "diptych/export.h"

DIPTYCH_BEGIN

/// Bad input, a setting out of range, or a file that cannot be read or written. `what()` is one line that names the
/// file, the object in it and the reason. A call that throws has
/// no effect, except that a session may have begun its picture anew.
class DIPTYCH_EXPORT Error : public std::runtime_error {
public:
    explicit Error(const std::string& message);
    Error(const Error&);
    ~Error() override;
};

/// A setting out of range, or one that does not fit the others. `what()` names it.
class DIPTYCH_EXPORT SettingError : public Error {
public:
    using Error::Error;
    ~SettingError() override;
};

/// The machine has no device that the backend needs. `what()` lists what is missing.
class DIPTYCH_EXPORT NoDevice : public Error {
public:
    using Error::Error;
    ~NoDevice() override;
};

/// The device has no room for what was asked of it. `what()` says what was asked for, what is in use and free, and what
/// would need less. Where the scene cannot fit, nothing is allocated before.
class DIPTYCH_EXPORT OutOfMemory : public Error {
public:
    using Error::Error;
    ~OutOfMemory() override;
};

/// The device was lost while it worked. A film taken before stays whole; the session can only be destroyed.
class DIPTYCH_EXPORT DeviceLost : public Error {
public:
    using Error::Error;
    ~DeviceLost() override;
};

/// A stop token ended a call that has no partial result (verify). A render that is stopped throws nothing.
class DIPTYCH_EXPORT Interrupted : public Error {
public:
    using Error::Error;
    ~Interrupted() override;
};

DIPTYCH_END
