//! Pictures that the layers of a show project on the floor.

use lightbots_base::Rgb;
use lightbots_light::{FloorPicture, PICTURE_PIXELS_MAX};
use lightbots_show::{Asset, AssetHash, Issue, Issues, Layer, LayerPicture, Setting, Show, excerpt, setting};
use std::collections::BTreeMap;
use std::sync::Arc;

/// Largest number of pictures of a show that are decoded, chosen by us: decoding one may take seconds.
pub const LAYER_PICTURES_MAX: usize = 64;

/// Converts a decoded picture or film for effects. `None` if it is empty, has more than [`PICTURE_PIXELS_MAX`] pixels, or
/// has no whole number of pictures.
pub fn floor_picture(picture: &LayerPicture) -> Option<FloorPicture> {
    let pixels = picture.codes.chunks_exact(3).map(|code| Rgb::new(code[0], code[1], code[2])).collect();
    FloorPicture::new(picture.width as usize, picture.height as usize, pixels).ok()
}

/// Decodes the pictures that layers of a show project, and stores each in the asset that it was decoded from. Returns a
/// warning for each file that cannot be shown. `decode` decodes a file; its error says what is wrong with the file and
/// what to do. At most [`LAYER_PICTURES_MAX`] pictures are stored, with at most [`PICTURE_PIXELS_MAX`] pixels in total,
/// because recordings and journals contain them.
pub fn attach_pictures(
    show: &mut Show,
    mut decode: impl FnMut(AssetHash, &Asset) -> Result<Arc<LayerPicture>, String>,
) -> Issues {
    let mut issues = Issues::new();
    let mut pixels = 0;
    for (nth, (hash, number)) in users(&show.layers).into_iter().enumerate() {
        // A file that the show lacks is reported with the settings of the layer.
        let Some(asset) = show.assets.get_mut(&hash) else { continue };
        let decoded = if nth < LAYER_PICTURES_MAX { decode(hash, asset) } else { Err(too_many()) };
        let decoded = decoded.and_then(|picture| {
            let sum = pixels + picture.pixels();
            if sum > PICTURE_PIXELS_MAX {
                return Err(too_large());
            }
            pixels = sum;
            Ok(picture)
        });
        match decoded {
            Ok(picture) => asset.picture = Some(picture),
            Err(why) => {
                asset.picture = None;
                let layer = layer_words(&show.layers[number], number);
                let message = format!("{layer}: \"{}\" cannot be shown: {why}", excerpt(&asset.name));
                issues.push(Issue::warning("layer-picture", message));
            }
        }
    }
    issues
}

/// The hashes of the files that layers project, each with the index of the first layer that projects the file.
fn users(layers: &[Layer]) -> BTreeMap<AssetHash, usize> {
    let mut users = BTreeMap::new();
    let projects = |layer: &Layer| matches!(layer.kind.as_str(), "picture" | "sequence");
    for (number, layer) in layers.iter().enumerate().filter(|(_, layer)| projects(layer)) {
        if let Some(Setting::Text(hash)) = setting(&layer.settings, "picture")
            && let Some(hash) = AssetHash::from_hex(hash)
        {
            users.entry(hash).or_insert(number);
        }
    }
    users
}

fn layer_words(layer: &Layer, number: usize) -> String {
    match layer.name.as_str() {
        "" => format!("layer {}", number + 1),
        name => format!("the layer \"{}\"", excerpt(name)),
    }
}

fn too_many() -> String {
    format!("layers project more than {LAYER_PICTURES_MAX} pictures; use fewer")
}

fn too_large() -> String {
    let most = PICTURE_PIXELS_MAX / 1_000_000;
    format!("the pictures of all layers have more than {most} million pixels together; use fewer films")
}

#[cfg(test)]
mod tests {
    use super::*;
    use lightbots_show::LayerSpan;

    fn show(pictures: u8, layers: u8) -> Show {
        let hash = |nth: u8| AssetHash([nth; 32]);
        let asset = |nth: u8| Asset {
            name: format!("{nth}.png"),
            media_type: "image/png".into(),
            bytes: 9,
            content: None,
            picture: None,
        };
        let layer = |nth: u8| Layer {
            name: if nth == 1 { "Logo".into() } else { String::new() },
            kind: "picture".into(),
            span: LayerSpan::Show,
            settings: vec![("picture".into(), Setting::Text(hash(nth).to_string()))],
        };
        let assets = (0..pictures).map(|nth| (hash(nth), asset(nth))).collect();
        Show { assets, layers: (0..layers).map(layer).collect(), ..Show::default() }
    }

    fn picture(width: u32) -> Arc<LayerPicture> {
        Arc::new(LayerPicture { width, height: 1, codes: vec![7; 3 * width as usize] })
    }

    #[test]
    fn a_file_that_cannot_be_decoded_is_named_with_its_layer_and_the_others_shine() {
        let mut show = show(3, 2);
        let issues = attach_pictures(&mut show, |hash, asset| {
            assert_eq!(asset.name, format!("{}.png", hash.0[0]));
            if hash.0[0] == 1 { Err("it is cut off. Copy it again.".into()) } else { Ok(picture(2)) }
        });
        let said: Vec<&str> = issues.iter().map(|issue| issue.message.as_str()).collect();
        assert_eq!(said, ["the layer \"Logo\": \"1.png\" cannot be shown: it is cut off. Copy it again."]);
        // The file that no layer projects is not decoded.
        let has: Vec<bool> = show.assets.values().map(|asset| asset.picture.is_some()).collect();
        assert_eq!(has, [true, false, false]);
    }

    #[test]
    fn pictures_are_bounded_in_number_and_in_pixels() {
        let mut many = show(70, 70);
        let mut decoded = 0;
        let issues = attach_pictures(&mut many, |_, _| {
            decoded += 1;
            Ok(picture(1))
        });
        assert_eq!((decoded, issues.len()), (LAYER_PICTURES_MAX, 70 - LAYER_PICTURES_MAX));
        let mut large = show(3, 3);
        let issues = attach_pictures(&mut large, |_, _| Ok(picture(PICTURE_PIXELS_MAX as u32 / 2)));
        assert!(issues.len() == 1 && issues[0].message.contains("4 million pixels"), "{issues:?}");
    }

    #[test]
    fn a_decoded_picture_that_is_not_whole_is_none() {
        assert!(floor_picture(&picture(3)).is_some());
        assert!(floor_picture(&LayerPicture { width: 2, height: 2, codes: vec![0; 9] }).is_none());
        assert!(floor_picture(&LayerPicture::default()).is_none());
    }
}
