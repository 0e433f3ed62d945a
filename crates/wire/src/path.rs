//! `PATH seq x y piece…`: a route as text, in tenths of a millimetre and microseconds.
//!
//! A piece is `R us` (rest), `L us x y` (straight at constant speed) or `C us x1 y1 x2 y2 x y` (cubic Bézier). After
//! the pieces may come `G room`, the planned clearance in millimetres, and the neighbours.

use core::fmt::{self, Write};

use lightbots_base::{Piece, Span, Vec2};

use crate::fields::Fields;
use crate::number::{metres, span, tenths, write_digits, write_int};
use crate::text_buffer::TextBuffer;
use crate::{Neighbours, Pieces, Route};

/// A place as x and y in whole tenths of a millimetre, as it is sent. Controller and robot then calculate with equal
/// values.
type Tenths = [i32; 2];

/// Reads the route after the word `PATH`. `None` if there are more than `MAX_PIECES` pieces, or a field is missing or
/// invalid. An invalid entry among the neighbours only ends their list (R31).
pub(crate) fn decode_route(fields: &mut Fields<'_>) -> Option<Route> {
    let seq = fields.next()?.parse().ok().filter(|&seq| seq != 0)?;
    let start = place(fields)?;
    let mut route = Route { seq, start, pieces: Pieces::new(), room_mm: None, neighbours: Neighbours::new() };
    let mut from = start;
    while let Some(kind) = fields.next() {
        if kind == "G" {
            route.room_mm = Some(fields.next()?.parse().ok()?);
            route.neighbours = Neighbours::decode(fields);
            break;
        }
        let piece = decode_piece(kind, from, fields)?;
        from = piece.end;
        route.pieces.push(piece).ok()?;
    }
    Some(route)
}

fn decode_piece(kind: &str, from: Vec2, fields: &mut Fields<'_>) -> Option<Piece> {
    let duration = fields.next().and_then(span).filter(|&duration| duration > Span::ZERO)?;
    Some(match kind {
        "R" => Piece::rest(from, duration),
        "L" => Piece::straight(from, place(fields)?, duration),
        "C" => Piece { duration, c1: place(fields)?, c2: place(fields)?, end: place(fields)? },
        _ => return None,
    })
}

fn place(fields: &mut Fields<'_>) -> Option<Vec2> {
    let (x, y) = (metres(fields.next()?)?, metres(fields.next()?)?);
    Some(Vec2::new(x, y))
}

/// Writes `PATH …` without the bars around a command. Places are rounded to a tenth of a millimetre and limited to
/// ±1000 m. Durations are at least one microsecond. Neighbours are written only after a known clearance.
pub(crate) fn encode_route(route: &Route, out: &mut TextBuffer<'_>) -> fmt::Result {
    out.write_str("PATH ")?;
    write_int(out, i64::from(route.seq))?;
    let mut from = rounded(route.start);
    write_place(out, from)?;
    for piece in &route.pieces {
        encode_piece(piece, from, out)?;
        from = rounded(piece.end);
    }
    if let Some(room_mm) = route.room_mm {
        out.write_str(" G ")?;
        write_int(out, i64::from(room_mm))?;
        route.neighbours.encode(out)?;
    }
    Ok(())
}

fn encode_piece(piece: &Piece, from: Tenths, out: &mut TextBuffer<'_>) -> fmt::Result {
    let (c1, c2, end) = (rounded(piece.c1), rounded(piece.c2), rounded(piece.end));
    let even = Piece::straight(metres_of(from), metres_of(end), piece.duration);
    let kind = if c1 == from && c2 == from && end == from {
        " R "
    } else if c1 == rounded(even.c1) && c2 == rounded(even.c2) {
        " L "
    } else {
        " C "
    };
    out.write_str(kind)?;
    write_digits(out, piece.duration.0.max(1).unsigned_abs(), 1)?;
    if kind == " C " {
        write_place(out, c1)?;
        write_place(out, c2)?;
    }
    if kind != " R " { write_place(out, end) } else { Ok(()) }
}

fn rounded(at: Vec2) -> Tenths {
    [tenths(at.x), tenths(at.y)]
}

fn metres_of(at: Tenths) -> Vec2 {
    Vec2::new(f64::from(at[0]) / 1e4, f64::from(at[1]) / 1e4)
}

fn write_place(out: &mut TextBuffer<'_>, at: Tenths) -> fmt::Result {
    for coordinate in at {
        out.write_str(" ")?;
        write_int(out, i64::from(coordinate))?;
    }
    Ok(())
}
