#include "diptych/error.h"

DIPTYCH_BEGIN

// Out of line, so that each exception has one type in all libraries of a process.
Error::Error(const std::string& message) : std::runtime_error(message) {}
Error::Error(const Error&) = default;
Error::~Error() = default;
SettingError::~SettingError() = default;
NoDevice::~NoDevice() = default;
OutOfMemory::~OutOfMemory() = default;
DeviceLost::~DeviceLost() = default;
Interrupted::~Interrupted() = default;

DIPTYCH_END
