#pragma once
// What a topic says: tables, charts, pictures and checks, in one form that the page draws without knowing the topic.

#include "lab.h"

#include <koksma/measure/ratio.h>

#include <nlohmann/json.hpp>

namespace koksma::lecture {

using Json = nlohmann::ordered_json;

// Cells and points: {"value", "lo", "hi"}, null where there is none.
[[nodiscard]] Json mean_of(const std::vector<double>& replicates);       ///< of what may have either sign
[[nodiscard]] Json error_of(const std::vector<double>& squared_errors);  ///< the mean: an MSE
[[nodiscard]] Json root_of(const std::vector<double>& squared_errors);   ///< an RMSE
[[nodiscard]] Json times(Json cell, double factor);
[[nodiscard]] Json gain_of(const std::vector<double>& better, const std::vector<double>& baseline,
                           double factor = 1.0);  ///< MSE of baseline over MSE of better, times factor
[[nodiscard]] Json exactly(double value);

/// The page of one topic.
class Sheet {
public:
    explicit Sheet(const Lab& lab, std::string topic) : lab_(lab), topic_(std::move(topic)) {}

    void table(const std::string& title, const std::vector<std::string>& columns) {
        json_["tables"].push_back({{"title", title}, {"columns", columns}, {"rows", Json::array()}});
    }
    /// Of the last table; cells are text, numbers or {"value", "lo", "hi"}.
    void row(Json cells) { json_["tables"].back()["rows"].push_back(std::move(cells)); }

    struct Axes {
        std::string x, y;
        bool x_log = false, y_log = false;
    };
    void chart(const std::string& title, const Axes& axes) {
        json_["charts"].push_back(
            {{"title", title}, {"x", axes.x}, {"y", axes.y}, {"x_log", axes.x_log}, {"y_log", axes.y_log}, {"series", Json::array()}});
    }
    /// Measured points of the last chart. @param y  cells
    void points(const std::string& label, const std::vector<double>& x, Json y) {
        json_["charts"].back()["series"].push_back({{"label", label}, {"x", x}, {"y", std::move(y)}, {"known", false}});
    }
    /// A closed form, drawn as a dashed line.
    void known(const std::string& label, const std::vector<double>& x, const std::vector<double>& y) {
        Json cells = Json::array();
        for (const double v : y) cells.push_back(exactly(v));
        json_["charts"].back()["series"].push_back({{"label", label}, {"x", x}, {"y", cells}, {"known", true}});
    }

    /// @param exposure  0: one that suits the image
    void picture(const std::string& caption, const Image& image, int width, int height, float exposure = 0.0f);

    /// A closed form against what was measured: held where it lies inside an interval that holds the truth with probability 0.9999 (the one
    /// that is shown is the usual 95 %), or closer than `rounding` relatively or `allowed` absolutely.
    void check(const std::string& what, const std::vector<double>& measured, double expected, double rounding = 1e-5,
               double allowed = 1e-6);

    void note(const std::string& text) { json_["notes"].push_back(text); }
    [[nodiscard]] const Json& json() const noexcept { return json_; }
    [[nodiscard]] const Lab& lab() const noexcept { return lab_; }

private:
    const Lab& lab_;
    std::string topic_;
    Json json_ = {{"tables", Json::array()},
                  {"charts", Json::array()},
                  {"pictures", Json::array()},
                  {"checks", Json::array()},
                  {"notes", Json::array()}};
};

}  // namespace koksma::lecture
