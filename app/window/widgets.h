// The few widgets that the panels are made of, all aligned in the same two columns.
#pragma once

#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "settings/ranges.h"
#include "window/theme.h"

namespace diptych::core::app {

/// A heading that folds what follows; true while open.
bool section(const Theme& theme, const char* title, bool open = true);

/// A label in the left column; the next widget fills the right one. `help` appears under the pointer.
void row(const Theme& theme, const char* label, const char* help = nullptr);

/// A row with a choice among `names`; true where `chosen` has changed.
bool choice(const Theme& theme, const char* label, std::span<const char* const> names, int& chosen,
            const char* help = nullptr);

/// Rows with numbers. Double click or Ctrl+click on one types a number.
bool slider(const Theme& theme, const char* label, double& value, double least, double most, const char* format,
            const char* help = nullptr);
bool logarithmic_slider(const Theme& theme, const char* label, double& value, double least, double most,
                        const char* format, const char* help = nullptr);

/// The option, and under it the help.
std::string setting_help(const char* option, const std::string& help);

/// Rows with a setting: the command line's name as label, in the help the option, and the range that the renderer
/// accepts. `span` is what the slider spans where the scene's size decides that.
bool slider(const Theme& theme, const SettingRange& setting, double& value, const char* format, const std::string& help,
            const std::optional<NumberRange>& span = {});
bool slider(const Theme& theme, const SettingRange& setting, float& value, const char* format, const std::string& help);
bool slider(const Theme& theme, const SettingRange& setting, std::uint32_t& value, const std::string& help);
bool setting_toggle(const Theme& theme, const char* setting, bool& value, const std::string& help);

/// A choice among `offered`, by the command line's names.
template <typename Enum, typename NameOf>
bool setting_choice(const Theme& theme, const char* setting, std::initializer_list<Enum> offered, const NameOf& name,
                    Enum& chosen, const std::string& help) {
    std::vector<const char*> names;
    int index = 0;
    for (const Enum value : offered) {
        index = value == chosen ? static_cast<int>(names.size()) : index;
        names.push_back(name(value));
    }
    const bool changed = choice(theme, label_of(setting).c_str(), names, index, setting_help(setting, help).c_str());
    if (changed) {
        chosen = *(offered.begin() + index);
    }
    return changed;
}

bool toggle(const Theme& theme, const char* label, bool& value, const char* help = nullptr);

/// Buttons in one, of which one is down; true where `chosen` has changed. `width` is that of all.
bool segments(const char* id, std::span<const char* const> names, int& chosen, float width);

/// A button with text in the colour of notes, as wide as the text.
bool quiet_button(const char* text);

/// Text that a note or a unit has.
void note(const Theme& theme, const std::string& text, const ImVec4& color = colors::muted);
void note_wrapped(const Theme& theme, const std::string& text, const ImVec4& color = colors::muted);

/// Text at the right end of the column or line.
void right_aligned(const std::string& text, const ImVec4& color = colors::text);

/// What is under the pointer explains itself, after a moment.
void explain(const char* text);

ImU32 packed(const ImVec4& color);

}  // namespace diptych::core::app
