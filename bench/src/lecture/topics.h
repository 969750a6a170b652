#pragma once
// The topics of the lecture, each a function that measures and fills a sheet.

#include "sheet.h"

#include <span>

namespace koksma::lecture {

struct Topic {
    const char* name;
    const char* title;
    const char* slide;  ///< what the lecture says, in words; `|` before the reading of the page's figures
    void (*measure)(Sheet&);
};

void bounces(Sheet& sheet);
void parts(Sheet& sheet);
void direct_light(Sheet& sheet);
void directions(Sheet& sheet);
void truncation(Sheet& sheet);
void roulette(Sheet& sheet);
void absorption(Sheet& sheet);
void branching(Sheet& sheet);
void rays(Sheet& sheet);
void antialiasing(Sheet& sheet);
void adaptive(Sheet& sheet);
void sequences(Sheet& sheet);

/// In the order of the lecture.
[[nodiscard]] std::span<const Topic> topics() noexcept;

}  // namespace koksma::lecture
