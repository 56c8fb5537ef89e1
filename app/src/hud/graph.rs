//! A graph of the frame times with the line of the time limit.

use egui::{
    Align2, Color32, Painter, Pos2, Rect, Response, Role, Sense, Shape, Stroke, TextStyle, Ui, WidgetInfo,
    pos2, vec2,
};

use super::style;
use crate::{FrameRate, HISTORY, HudState};

/// Possible upper ends of the axis, in milliseconds.
const TOPS: [f32; 10] = [10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1e3, 2e3, 5e3, 1e4];
const HEIGHT: f32 = 72.0;

/// Draws the times of the last frames, the newest at the right edge; hovering shows a frame's time.
pub fn show(ui: &mut Ui, hud_state: &HudState, governor: Option<FrameRate>) {
    let width = ui.available_width().max(1.0);
    let (rect, response) = ui.allocate_exact_size(vec2(width, HEIGHT), Sense::hover());
    let times: Vec<f32> = hud_state.frame_ms.iter().map(|ms| finite(*ms)).collect();
    let budget = governor.map(|rate| rate.budget_ms() as f32);
    let top = top(times.iter().copied().chain(budget).fold(0.0, f32::max));
    let painter = ui.painter_at(rect);
    painter.rect_filled(rect, 6.0, Color32::from_black_alpha(90));
    curve(&painter, rect, &times, top, budget);
    let font = TextStyle::Small.resolve(ui.style());
    let corner = rect.left_top() + vec2(6.0, 4.0);
    painter.text(corner, Align2::LEFT_TOP, format!("{top:.0} ms"), font.clone(), Color32::from_gray(130));
    if let Some(budget) = budget {
        let y = height(rect, budget, top);
        let line = [pos2(rect.left(), y), pos2(rect.right(), y)];
        painter.extend(Shape::dashed_line(&line, Stroke::new(1.0, style::WARNING), 4.0, 4.0));
        let text = format!("{budget:.1} ms, {:.0} fps", 1000.0 / budget);
        painter.text(pos2(rect.right() - 6.0, y - 2.0), Align2::RIGHT_BOTTOM, text, font, style::WARNING);
    }
    let response = named(response, &times);
    if let Some(ms) = response.hover_pos().and_then(|pointer| pointed(rect, &times, pointer)) {
        response.on_hover_text_at_pointer(format!("{ms:.1} ms, {:.0} fps", 1000.0 / ms.max(1e-3)));
    }
}

fn curve(painter: &Painter, rect: Rect, times: &[f32], top: f32, budget: Option<f32>) {
    let points: Vec<Pos2> = times
        .iter()
        .enumerate()
        .map(|(i, ms)| pos2(column(rect, times.len(), i), height(rect, *ms, top)))
        .collect();
    for (pair, ms) in points.windows(2).zip(times.iter().skip(1)) {
        let late = budget.is_some_and(|budget| *ms > budget);
        let color = if late { style::WARNING } else { style::ACCENT };
        painter.line_segment([pair[0], pair[1]], Stroke::new(1.5, color));
    }
}

fn named(response: Response, times: &[f32]) -> Response {
    let newest = times.last().copied().unwrap_or(0.0);
    response.widget_info(|| {
        let text = format!("frame times, the newest {newest:.1} ms");
        WidgetInfo::labeled(Role::Label, true, text)
    });
    response
}

fn finite(ms: f32) -> f32 {
    if ms.is_finite() { ms.max(0.0) } else { 0.0 }
}

fn top(most: f32) -> f32 {
    TOPS.into_iter().find(|top| *top >= most).unwrap_or(most)
}

fn column(rect: Rect, len: usize, index: usize) -> f32 {
    rect.right() - (len - 1 - index) as f32 / (HISTORY - 1) as f32 * rect.width()
}

fn height(rect: Rect, ms: f32, top: f32) -> f32 {
    rect.bottom() - ms / top * rect.height()
}

fn pointed(rect: Rect, times: &[f32], pointer: Pos2) -> Option<f32> {
    let back = (rect.right() - pointer.x) / rect.width() * (HISTORY - 1) as f32;
    times.iter().rev().nth(back.round().max(0.0) as usize).copied()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_top_is_the_next_round_time() {
        assert_eq!([0.0, 9.9, 33.3, 20_000.0].map(top), [10.0, 10.0, 50.0, 20_000.0]);
    }

    #[test]
    fn the_newest_time_is_at_the_right_edge_where_it_is_read() {
        let rect = Rect::from_min_size(Pos2::ZERO, vec2(239.0, 50.0));
        let times = [1.0, 2.0, 3.0];
        for (index, ms) in times.into_iter().enumerate() {
            let point = pos2(column(rect, 3, index), height(rect, ms, 10.0));
            assert_eq!(pointed(rect, &times, point), Some(ms));
            assert_eq!(point, pos2(237.0 + index as f32, 50.0 - 5.0 * ms));
        }
        assert_eq!(pointed(rect, &times, pos2(10.0, 0.0)), None);
    }
}
