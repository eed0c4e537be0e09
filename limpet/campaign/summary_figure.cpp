// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "limpet/campaign/summary.hpp"
#include "limpet/core/errors.hpp"
#include "limpet/report/gnuplot.hpp"
#include "limpet/report/layout.hpp"
#include "limpet/report/pictures.hpp"

namespace limpet {
namespace {

constexpr const char* kInk = "#222B33";
constexpr const char* kFaint = "#6B7680";
constexpr const char* kGrid = "#DDE2E7";
constexpr const char* kBlue = "#0B3C5D";
constexpr const char* kLight = "#6FA8D6";
constexpr const char* kOrange = "#D98E04";

constexpr std::size_t kMostPanels = 8;
constexpr int kWidth_px = 900;
constexpr double kLeft_px = 84.0;
constexpr double kRight_px = kWidth_px - 40.0;
constexpr double kBarsLeft_px = 180.0;
constexpr double kHead_px = 84.0;
constexpr double kBar_px = 34.0;
constexpr double kBarsAxis_px = 58.0;
constexpr double kPanel_px = 300.0;
constexpr double kPanelAxis_px = 96.0;
constexpr double kFont_px = 15.0;

/// Blocks of the data file: outcomes, then a block a key.
std::string data_of(const CampaignSummary& summary, std::size_t panels) {
    const auto row = [](double x, const Proportion& p) {
        const Interval interval = p.interval();
        return fmt::format("{:.10g} {:.10g} {:.10g} {:.10g}\n", x, p.probability(), interval.low,
                           interval.high);
    };
    std::string text;
    for (std::size_t i = 0; i < summary.outcomes.size(); ++i) {
        text += row(static_cast<double>(i), summary.outcomes[i].proportion);
    }
    for (std::size_t k = 0; k < panels; ++k) {
        text += "\n\n";
        const KeySummary& key = summary.keys[k];
        for (std::size_t i = 0; i < key.groups.size(); ++i) {
            const Group& group = key.groups[i];
            if (group.proportion.runs > 0) {
                text += row(key.named ? static_cast<double>(i) : group.middle(), group.proportion);
            }
        }
    }
    return text;
}

class Script {
public:
    Script(const CampaignSummary& summary, std::size_t panels) : summary_(summary) {
        bars_bottom_px_ = kHead_px + kBar_px * static_cast<double>(summary.outcomes.size());
        page_ = {kWidth_px,
                 static_cast<int>(bars_bottom_px_ + kBarsAxis_px +
                                  static_cast<double>(panels) * (kPanel_px + kPanelAxis_px))};
    }

    [[nodiscard]] const Canvas& page() const { return page_; }

    [[nodiscard]] std::string body(std::size_t panels) {
        add("set multiplot\nset encoding utf8\nunset key\nset tics scale 0.4 nomirror textcolor "
            "rgb "
            "'{}'\n",
            kInk);
        add("set border 3 lc rgb '{}' lw 0.8\nset grid lt 1 lc rgb '{}' lw 0.8\n", kFaint, kGrid);
        title();
        outcomes();
        for (std::size_t k = 0; k < panels; ++k) {
            panel(k);
        }
        add("unset multiplot\nunset output\n");
        return std::move(text_);
    }

private:
    template <class... Values>
    void add(const char* format, const Values&... values) {
        text_ += fmt::vformat(format, fmt::make_format_args(values...));
    }

    void margins(double left_px, double top_px, double bottom_px) {
        add("set lmargin at screen {:.5f}\nset rmargin at screen {:.5f}\n", page_.x(left_px),
            page_.x(kRight_px));
        add("set tmargin at screen {:.5f}\nset bmargin at screen {:.5f}\n", page_.y(top_px),
            page_.y(bottom_px));
    }

    void label(double x_px, double y_px, const std::string& text, double size_px,
               const char* colour) {
        add("set label {} at screen {:.5f}, screen {:.5f} left noenhanced font 'DejaVu Sans,{}' "
            "textcolor rgb '{}' front\n",
            gnuplot::literal(text), page_.x(x_px), page_.y(y_px), size_px, colour);
    }

    void title() {
        label(20.0, 26.0, summary_.name + ": " + summary_.description, 19.0, kInk);
        label(
            20.0, 54.0,
            fmt::format("{} of {} runs of {}, seed {}; points and bars with 95 % Wilson intervals",
                        summary_.finished, summary_.runs, summary_.scenario, summary_.seed),
            14.0, kFaint);
    }

    void outcomes() {
        margins(kBarsLeft_px, kHead_px, bars_bottom_px_);
        std::string names;
        for (std::size_t i = 0; i < summary_.outcomes.size(); ++i) {
            names += fmt::format("{}{} {}", names.empty() ? "" : ", ",
                                 gnuplot::literal(summary_.outcomes[i].outcome), i);
        }
        add("set xrange [0:1]\nset yrange [{}:-0.5]\nset ytics ({}) noenhanced\n",
            static_cast<double>(summary_.outcomes.size()) - 0.5, names);
        add("set xlabel 'share of the runs'\n");
        add("plot DATA index 0 using (0):1:(0):2:($1-0.3):($1+0.3) with boxxyerror fs solid "
            "noborder "
            "fc rgb '{}', "
            "DATA index 0 using 2:1:3:4 with xerrorbars pt 0 lw 1.6 lc rgb '{}'\n",
            kLight, kBlue);
        add("unset label\nset ytics autofreq\n");
    }

    void panel(std::size_t k) {
        const KeySummary& key = summary_.keys[k];
        const double top_px = bars_bottom_px_ + kBarsAxis_px + 20.0 +
                              static_cast<double>(k) * (kPanel_px + kPanelAxis_px);
        margins(kLeft_px, top_px, top_px + kPanel_px);
        add("set yrange [-0.02:1.02]\nset ytics 0.2\nset ylabel 'probability of success'\n");
        add("set xlabel {} noenhanced\n", gnuplot::literal(key.key));
        key.named ? named_axis(key) : number_axis(key);
        const std::string points = fmt::format(
            "DATA index {} using 1:2:3:4 with yerrorbars pt 7 ps 0.8 lw 1.4 lc rgb '{}'", k + 1,
            kBlue);
        if (key.fit) {
            add("plot 1/(1+exp(-({:.10g}+({:.10g})*x))) with lines lw 2 lc rgb '{}', {}\n",
                key.fit->intercept, key.fit->slope, kOrange, points);
        } else {
            add("plot {}\n", points);
        }
        add("set xtics autofreq\n");
    }

    void named_axis(const KeySummary& key) {
        std::string names;
        for (std::size_t i = 0; i < key.groups.size(); ++i) {
            names += fmt::format("{}{} {}", names.empty() ? "" : ", ",
                                 gnuplot::literal(key.groups[i].label), i);
        }
        add("set xrange [-0.5:{}]\nset xtics ({}) noenhanced\n",
            static_cast<double>(key.groups.size()) - 0.5, names);
    }

    void number_axis(const KeySummary& key) {
        const double low = key.groups.front().low;
        const double high = key.groups.back().high;
        const double air = high > low ? 0.04 * (high - low) : 0.5;
        add("set xrange [{:.10g}:{:.10g}]\n", low - air, high + air);
    }

    const CampaignSummary& summary_;
    double bars_bottom_px_ = 0.0;
    Canvas page_;
    std::string text_;
};

std::string script_of(const CampaignSummary& summary, std::size_t panels) {
    Script script(summary, panels);
    const std::string size = fmt::format("size {},{} font 'DejaVu Sans,{}' background '#FFFFFF'",
                                         script.page().width_px, script.page().height_px, kFont_px);
    const std::string body = script.body(panels);
    return "DATA = 'summary.txt'\n" +
           fmt::format("set terminal pngcairo {} fontscale 0.75\nset output 'summary.png'\n",
                       size) +
           body + fmt::format("reset\nset terminal svg {}\nset output 'summary.svg'\n", size) +
           body;
}

}  // namespace

std::vector<std::filesystem::path> draw_summary(const CampaignSummary& summary,
                                                const std::filesystem::path& folder) {
    if (summary.finished == 0) {
        return {};
    }
    const std::size_t panels = std::min(summary.keys.size(), kMostPanels);
    const gnuplot::TemporaryFolder work;
    std::ofstream data(work.path() / "summary.txt", std::ios::binary);
    data << data_of(summary, panels);
    data.close();
    if (!data) {
        throw InputError("cannot write in " + work.path().string() + ": is the disk full?");
    }
    gnuplot::run(work.path(), script_of(summary, panels));
    return publish({work.path() / "summary.png", work.path() / "summary.svg"}, folder);
}

}  // namespace limpet
