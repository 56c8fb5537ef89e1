//! SVG plots of PSNR against cost. Written without a plotting crate, which would add fonts, backends and
//! colour maps to a few lines, dots and labels.

mod labels;
#[cfg(test)]
mod tests;

use std::fmt::Write;

use crate::pareto::Point;
use crate::rung::Family;
use labels::{Label, Labels};

/// Width in SVG units, of which the page shows at least one a pixel.
const WIDTH: f64 = 560.0;
/// Left, top, right and bottom edge of the plot area, in SVG units.
const AREA: [f64; 4] = [60.0, 40.0, 548.0, 420.0];
/// Top of the legend and height of its lines.
const LEGEND: [f64; 2] = [474.0, 19.0];
/// Number of columns of the legend.
const COLUMNS: usize = 2;
/// Colours where the reader prefers dark pages; elsewhere those of the attributes hold.
const DARK: &str = "<style>@media screen and (prefers-color-scheme: dark) { .plot { fill: #ddd } \
    .plot .ground { fill: #1a1a1a } .plot .grid { stroke: #3d3d3d } .plot .axis { stroke: #ddd } \
    .plot .symbol:not([stroke]) { stroke: #ddd } }</style>\n";

/// A point of the plot with its label.
#[derive(Clone, Debug)]
pub struct Mark {
    /// Text beside the point.
    pub label: String,
    /// Family, which gives colour and shape.
    pub family: Family,
    /// Cost and PSNR.
    pub point: Point,
    /// 95 % confidence interval of the cost, if there is one.
    pub interval: Option<[f64; 2]>,
    /// Whether the point is on the Pareto front.
    pub front: bool,
}

/// Draws the marks as an SVG document, with axes scaled to fit them. The legend lists families in the order
/// of their first marks.
pub fn draw(title: &str, x_title: &str, marks: &[Mark]) -> String {
    let scales = Scales::of(marks);
    // Writing to a String cannot fail.
    let mut svg = String::new();
    let families = families(marks);
    let height = LEGEND[0] + families.len().div_ceil(COLUMNS) as f64 * LEGEND[1];
    let _ = write!(
        svg,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {height}\" role=\"img\" class=\"plot\" \
         font-family=\"system-ui, sans-serif\" font-size=\"12\" fill=\"#222\">\n{DARK}\
         <rect width=\"{WIDTH}\" height=\"{height}\" class=\"ground\" fill=\"#fff\"/>\n\
         <text x=\"{}\" y=\"24\" font-size=\"15\" font-weight=\"600\">{}: PSNR against {}</text>\n",
        AREA[0],
        escaped(title),
        escaped(x_title)
    );
    svg += &axes(&scales, x_title);
    svg += &front(&scales, marks);
    let places: Vec<_> = marks.iter().map(|mark| scales.place(mark.point)).collect();
    for (mark, [_, y]) in marks.iter().zip(&places) {
        svg += &mark.interval.map_or_else(String::new, |interval| bar(&scales, mark.family, interval, *y));
    }
    for (mark, [x, y]) in marks.iter().zip(&places) {
        svg += &symbol(mark.family, *x, *y, mark.front);
    }
    let line: Vec<_> = on_front(marks).into_iter().map(|point| scales.place(point)).collect();
    let mut labels = Labels::around(&places, &line, AREA);
    for (mark, place) in marks.iter().zip(&places) {
        let infinite = if mark.point.psnr_db.is_finite() { "" } else { " (equal)" };
        let text = format!("{}{infinite}", mark.label);
        let Label { at: [x, y], leader } = labels.place(*place, &text);
        if let Some([to_x, to_y]) = leader {
            let [x, y] = place;
            let _ = writeln!(svg, "<path d=\"M{x:.1} {y:.1}L{to_x:.1} {to_y:.1}\" stroke=\"#999\"/>");
        }
        let weight = if mark.front { " font-weight=\"600\"" } else { "" };
        let _ = writeln!(
            svg,
            "<text x=\"{x:.1}\" y=\"{y:.1}\" font-size=\"12\"{weight}>{}</text>",
            escaped(&text)
        );
    }
    svg += &legend(&families);
    svg + "</svg>\n"
}

/// Maps cost (logarithmic) and PSNR (linear) to SVG coordinates.
struct Scales {
    /// log10 of the least and the greatest cost, with margins.
    x: [f64; 2],
    /// Least and greatest PSNR in decibels, with margins.
    y: [f64; 2],
}

impl Scales {
    fn of(marks: &[Mark]) -> Self {
        let fit = |values: &mut dyn Iterator<Item = f64>, margin: f64| {
            let finite = values.filter(|v| v.is_finite());
            let [low, high] =
                finite.fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], v| [l.min(v), h.max(v)]);
            if low > high {
                return [0.0, 1.0];
            }
            let margin = (margin * (high - low)).max(0.05);
            [low - margin, high + margin]
        };
        Self {
            x: fit(&mut marks.iter().map(|m| m.point.cost.log10()), 0.06),
            y: fit(&mut marks.iter().map(|m| m.point.psnr_db), 0.08),
        }
    }

    fn x(&self, cost: f64) -> f64 {
        AREA[0] + (cost.log10() - self.x[0]) / (self.x[1] - self.x[0]) * (AREA[2] - AREA[0])
    }

    /// Vertical position; infinite PSNR (equal pictures) is drawn at the top.
    fn y(&self, psnr_db: f64) -> f64 {
        let share = ((psnr_db - self.y[0]) / (self.y[1] - self.y[0])).min(1.0);
        AREA[3] - share * (AREA[3] - AREA[1])
    }

    fn place(&self, point: Point) -> [f64; 2] {
        [self.x(point.cost), self.y(point.psnr_db)]
    }
}

fn axes(scales: &Scales, x_title: &str) -> String {
    let [left, top, right, bottom] = AREA;
    let mut svg = String::new();
    for cost in logarithmic_ticks(scales.x) {
        let x = scales.x(cost);
        let _ = write!(
            svg,
            "<path d=\"M{x:.1} {top}V{bottom}\" class=\"grid\" stroke=\"#e4e4e4\"/>\n\
             <text x=\"{x:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{cost}</text>\n",
            bottom + 18.0
        );
    }
    for psnr_db in linear_ticks(scales.y) {
        let y = scales.y(psnr_db);
        let _ = write!(
            svg,
            "<path d=\"M{left} {y:.1}H{right}\" class=\"grid\" stroke=\"#e4e4e4\"/>\n\
             <text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{psnr_db}</text>\n",
            left - 8.0,
            y + 4.0
        );
    }
    let _ = write!(
        svg,
        "<path d=\"M{left} {top}V{bottom}H{right}\" class=\"axis\" stroke=\"#222\" fill=\"none\"/>\n\
         <text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{} (logarithmic)</text>\n\
         <text transform=\"translate(18 {:.1}) rotate(-90)\" text-anchor=\"middle\">PSNR in dB</text>\n",
        0.5 * (left + right),
        bottom + 38.0,
        escaped(x_title),
        0.5 * (top + bottom)
    );
    svg
}

/// Tick values 1, 2 and 5 times powers of ten, between the decimal logarithms `low` and `high`.
fn logarithmic_ticks([low, high]: [f64; 2]) -> Vec<f64> {
    let decades = low.floor() as i32..=high.ceil() as i32;
    let ticks = decades.flat_map(|decade| [1.0, 2.0, 5.0].map(|digit| digit * 10_f64.powi(decade)));
    ticks.filter(|tick| (low..=high).contains(&tick.log10())).collect()
}

/// Tick values at the smallest step of 0.1, 0.2, 0.5, ... that divides the range into at most nine steps.
fn linear_ticks([low, high]: [f64; 2]) -> Vec<f64> {
    let steps = [0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0];
    let step = steps.into_iter().find(|step| (high - low) / step <= 9.0).unwrap_or(100.0);
    let [first, last] = [(low / step).ceil() as i64, (high / step).floor() as i64];
    // Steps below 1 divide instead of multiplying, so that 3 / 10 prints as 0.3.
    (first..=last)
        .map(|i| if step < 1.0 { i as f64 / (1.0 / step).round() } else { i as f64 * step })
        .collect()
}

/// Points of the front by increasing cost.
fn on_front(marks: &[Mark]) -> Vec<Point> {
    let mut points: Vec<_> = marks.iter().filter(|m| m.front).map(|m| m.point).collect();
    points.sort_by(|a, b| a.cost.total_cmp(&b.cost));
    points
}

fn front(scales: &Scales, marks: &[Mark]) -> String {
    let line: Vec<_> =
        on_front(marks).iter().map(|p| scales.place(*p)).map(|[x, y]| format!("{x:.1},{y:.1}")).collect();
    format!("<polyline points=\"{}\" fill=\"none\" stroke=\"#d1495b\" stroke-width=\"2\"/>\n", line.join(" "))
}

/// Draws a square for a baseline, a dot for an adaptive setting, with a ring if it is on the front.
fn symbol(family: Family, x: f64, y: f64, front: bool) -> String {
    let ring = if front { " stroke=\"#d1495b\" stroke-width=\"2\"" } else { "" };
    let color = family.color;
    if family.is_baseline {
        let [left, top] = [x - 4.5, y - 4.5];
        format!(
            "<rect x=\"{left:.1}\" y=\"{top:.1}\" width=\"9\" height=\"9\" class=\"symbol\" fill=\"{color}\"{ring}/>\n"
        )
    } else {
        format!("<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"5\" class=\"symbol\" fill=\"{color}\"{ring}/>\n")
    }
}

/// Draws a confidence interval of the cost as a horizontal line with ends, as far as it is within the plot area.
fn bar(scales: &Scales, family: Family, interval: [f64; 2], y: f64) -> String {
    let [low, high] = interval.map(|cost| scales.x(cost).clamp(AREA[0], AREA[2]));
    let [top, bottom] = [y - 3.5, y + 3.5];
    format!(
        "<path d=\"M{low:.1} {top:.1}V{bottom:.1}M{low:.1} {y:.1}H{high:.1}M{high:.1} {top:.1}V{bottom:.1}\" \
         stroke=\"{}\" stroke-width=\"1.5\"/>\n",
        family.color
    )
}

/// Families of the marks, in the order of their first marks.
fn families(marks: &[Mark]) -> Vec<Family> {
    let mut families: Vec<Family> = Vec::new();
    for mark in marks {
        if !families.contains(&mark.family) {
            families.push(mark.family);
        }
    }
    families
}

fn legend(families: &[Family]) -> String {
    let mut svg = String::new();
    let width = (AREA[2] - AREA[0]) / COLUMNS as f64;
    for (index, family) in families.iter().enumerate() {
        let x = AREA[0] + 8.0 + (index % COLUMNS) as f64 * width;
        let y = LEGEND[0] + (index / COLUMNS) as f64 * LEGEND[1];
        svg += &symbol(*family, x, y, false);
        let Family { letters, name, .. } = family;
        let _ = writeln!(svg, "<text x=\"{:.1}\" y=\"{:.1}\">{letters}: {name}</text>", x + 10.0, y + 4.0);
    }
    svg
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
