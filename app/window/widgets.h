// The few widgets that the panels are made of, all aligned in the same two columns.
#pragma once

#include <initializer_list>
#include <span>
#include <string>

#include "window/theme.h"

namespace diptych::app {

/// A heading that folds what follows; true while open.
bool section(const Theme& theme, const char* title, bool open = true);

/// A label in the left column; the next widget fills the right one. `help` appears under the pointer.
void row(const Theme& theme, const char* label, const char* help = nullptr);

/// A row with a choice among `names`; true where `chosen` has changed.
bool choice(const Theme& theme, const char* label, std::span<const char* const> names, int& chosen,
            const char* help = nullptr);

/// The same for an enum whose values count from 0.
template <typename Enum>
bool choice(const Theme& theme, const char* label, std::initializer_list<const char*> names, Enum& chosen,
            const char* help = nullptr) {
    int index = static_cast<int>(chosen);
    const bool changed = choice(theme, label, std::span<const char* const>(names.begin(), names.size()), index, help);
    chosen = static_cast<Enum>(index);
    return changed;
}

/// Rows with numbers. Double click or Ctrl+click on one types a number.
bool slider(const Theme& theme, const char* label, double& value, double least, double most, const char* format,
            const char* help = nullptr);
bool logarithmic_slider(const Theme& theme, const char* label, double& value, double least, double most,
                        const char* format, const char* help = nullptr);
bool slider(const Theme& theme, const char* label, std::uint32_t& value, std::uint32_t least, std::uint32_t most,
            const char* help = nullptr);
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

}  // namespace diptych::app
